#include "messages.h"

#include <cstdio>

namespace raytrace {

namespace {

Verbosity told = Verbosity::warnings;

void write(const char* weight, const std::string& text) {
  std::fprintf(stderr, "raytrace: %s%s\n", weight, text.c_str());
}

}  // namespace

void set_verbosity(Verbosity verbosity) { told = verbosity; }

bool tells(Verbosity verbosity) { return verbosity <= told; }

void tell_error(const std::string& text) { write("error: ", text); }

void tell_warning(const std::string& text) {
  if (tells(Verbosity::warnings)) write("warning: ", text);
}

void tell_step(const std::string& text) {
  if (tells(Verbosity::steps)) write("", text);
}

std::string counted(std::uint64_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

}  // namespace raytrace
