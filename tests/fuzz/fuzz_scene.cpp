// libFuzzer target: any bytes as a scene file, at several frames and with the variables that it names. They are read
// without a crash, a hang or a report of a sanitizer; what is accepted can be printed, and what is printed is read as
// the same scene again, with no more to say about it.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>
#include <string>

#include "fuzz/require.h"
#include "raytrace/description/scene_description.h"

namespace {

using namespace raytrace;

const std::map<std::string, std::string> known_variables = {
    {"size", "2"},
    {"huge", "1e17"},
    {"yes", "true"},
    {"text", "$frame <&amp;> \"\xc3\xa4'"},
    {"spaces", " a  b "},
    {"empty", ""},
    {"long", std::string(3000, 'x')},
};

/// With those variables that the text names: one that nothing uses is an error.
SceneSettings settings_for(const std::string& text, int frame) {
  SceneSettings settings{frame, {}};
  for (const auto& [name, value] : known_variables) {
    if (text.find('$' + name) != std::string::npos || text.find("${" + name) != std::string::npos)
      settings.variables.emplace(name, value);
  }
  return settings;
}

void read_and_print(const std::string& text, int frame) {
  Diagnostics diagnostics("fuzz.xml");
  const auto scene = parse_scene(text, diagnostics, 0, settings_for(text, frame));
  require(scene.has_value() != diagnostics.has_errors(), "a scene with errors, or none without\n");
  for (const Diagnostic& diagnostic : diagnostics.kept()) {
    const bool unused = diagnostic.message.starts_with("no value of the scene uses $");
    require(unused || (diagnostic.location.line > 0 && diagnostic.location.column > 0),
            "a diagnostic without a line\n");
    require(diagnostic.message.size() < 1000, "a message of any length\n");
  }
  std::ostringstream printed;
  diagnostics.print(printed);
  if (!scene) return;

  const std::string canonical = print_scene(*scene);
  Diagnostics again_diagnostics("printed.xml");
  const auto again = parse_scene(canonical, again_diagnostics);
  require(again && !again_diagnostics.has_errors(), "what is printed is not read again\n");
  require(again_diagnostics.warning_count() <= diagnostics.warning_count(), "what is printed has new warnings\n");
  require(print_scene(*again) == canonical, "what is printed is read as another scene\n");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  read_and_print(text, 1);
  // What depends on the frame has one of these.
  if (text.find('$') == std::string::npos && text.find("<key") == std::string::npos) return 0;
  for (const int frame : {-7, 3, std::numeric_limits<int>::max()}) read_and_print(text, frame);
  return 0;
}
