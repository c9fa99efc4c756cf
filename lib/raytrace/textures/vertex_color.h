// The colours that meshes have at their vertices, and clouds for their spheres.
//
//   <vertexcolor> <name>paint</name> </vertexcolor>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// White where a surface has none.
class VertexColor {
 public:
  struct Parameters {};
  static constexpr std::string_view group = "vertexcolors";
  static constexpr std::string_view element = "vertexcolor";
  static Fields fields() { return {}; }
};

}  // namespace raytrace
