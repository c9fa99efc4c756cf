#include "support/parsed_scene.h"

#include <sstream>
#include <stdexcept>

namespace raytrace::test {

SceneDescription parsed_scene(const std::string& text) {
  Diagnostics diagnostics("scene of a test");
  auto description = parse_scene(text, diagnostics);
  if (description && load_meshes(*description, diagnostics)) return std::move(*description);
  std::ostringstream message;
  diagnostics.print(message);
  throw std::runtime_error(message.str() + text);
}

}  // namespace raytrace::test
