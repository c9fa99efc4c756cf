// What clear materials have inside.
#pragma once

#include "raytrace/math/color.h"

namespace raytrace {

struct Medium {
  float ior = 1;  ///< index of refraction
  int priority = 0;
  Rgb<float> extinction{0, 0, 0};  ///< for a unit of length
};

}  // namespace raytrace
