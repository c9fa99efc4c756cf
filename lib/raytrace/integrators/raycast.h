// Direct light by ray casting (Suffern, chapters 14 to 16): the nearest hit, lit by the scene's lights, with a shadow
// ray to each that casts shadows.
//
//   <integrator> <raycast/> </integrator>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Raycast {
 public:
  struct Parameters {};
  static constexpr std::string_view element = "raycast";
  static Fields fields() { return {}; }
};

}  // namespace raytrace
