// Shading normals as colours, for looking at a model: each component of the normal, on the side that is in view, goes
// from -1 to 1 as its colour goes from 0 to 1. x is red, y green, z blue. Without lights.
//
//   <integrator> <normals/> </integrator>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Normals {
 public:
  struct Parameters {};
  static constexpr std::string_view element = "normals";
  static Fields fields() { return {}; }
};

}  // namespace raytrace
