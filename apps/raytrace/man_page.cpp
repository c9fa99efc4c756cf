// Prints a man page; run by the build.
//   raytrace_man_page         raytrace(1)
//   raytrace_man_page merge   raytrace-merge(1)
#include <iostream>

#include "about.h"
#include "manual.h"
#include "merge_command.h"
#include "options.h"

int main(int argc, char**) {
  using namespace raytrace;
  OptionParser parser;
  Options options;
  MergeOptions merge_options;
  if (argc == 1) {
    define_options(parser, options);
    std::cout << man_page(render_manual, parser.entries(), software_name()) << std::flush;
  } else {
    define_merge_options(parser, merge_options);
    std::cout << man_page(merge_manual, parser.entries(), software_name()) << std::flush;
  }
  return std::cout ? 0 : 1;
}
