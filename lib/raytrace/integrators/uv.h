// Texture coordinates as colours, for looking at a model: u is red and v green, without their whole numbers. Without
// lights.
//
//   <integrator> <uv/> </integrator>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Uv {
 public:
  struct Parameters {};
  static constexpr std::string_view element = "uv";
  static Fields fields() { return {}; }
};

}  // namespace raytrace
