// libFuzzer target: any bytes as a scene file. They are read without a crash, a hang or a report of a sanitizer; what
// is accepted can be printed, and what is printed is read as the same scene again.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

#include "raytrace/description/scene_description.h"

namespace {

void require(bool condition, const char* what) {
  if (condition) return;
  std::fputs(what, stderr);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace raytrace;
  Diagnostics diagnostics("fuzz.xml");
  const auto scene = parse_scene(std::string(data, data + size), diagnostics);
  require(scene.has_value() != diagnostics.has_errors(), "a scene with errors, or none without\n");
  for (const Diagnostic& diagnostic : diagnostics.kept()) {
    require(diagnostic.location.line > 0 && diagnostic.location.column > 0, "a finding without a place\n");
    require(diagnostic.message.size() < 1000, "a message of any length\n");
  }
  std::ostringstream printed;
  diagnostics.print(printed);
  if (!scene) return 0;

  const std::string text = print_scene(*scene);
  Diagnostics again_diagnostics("printed.xml");
  const auto again = parse_scene(text, again_diagnostics);
  require(again && again_diagnostics.kept().empty(), "what is printed is not read again\n");
  require(print_scene(*again) == text, "what is printed is read as another scene\n");
  return 0;
}
