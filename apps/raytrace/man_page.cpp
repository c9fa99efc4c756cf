// Prints the man page; run by the build.
#include <iostream>

#include "about.h"
#include "manual.h"
#include "options.h"

int main() {
  CLI::App parser;
  raytrace::Options options;
  raytrace::define_options(parser, options);
  std::cout << raytrace::man_page(parser, raytrace::software_name()) << std::flush;
  return std::cout ? 0 : 1;
}
