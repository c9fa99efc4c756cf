// The colours that meshes have at their vertices, and clouds for their spheres.
//
//   <vertexcolor> <name>paint</name> </vertexcolor>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// White, with an alpha of 1, where a surface has none.
class VertexColor {
 public:
  struct Parameters {
    double valuescale = 1, valueoffset = 0;  ///< of colour and alpha, as an image's
  };
  static constexpr std::string_view group = "vertexcolors";
  static constexpr std::string_view element = "vertexcolor";
  static Fields fields() {
    return {optional("valuescale", &Parameters::valuescale), optional("valueoffset", &Parameters::valueoffset)};
  }
};

}  // namespace raytrace
