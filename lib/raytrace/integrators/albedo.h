// The colours of surfaces without light, for looking at a model: what their materials reflect diffusely of light from
// all sides.
//
//   <integrator> <albedo/> </integrator>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Albedo {
 public:
  struct Parameters {};
  static constexpr std::string_view element = "albedo";
  static Fields fields() { return {}; }
};

}  // namespace raytrace
