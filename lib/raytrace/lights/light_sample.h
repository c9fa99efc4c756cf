// What a light sends to a point.
#pragma once

#include "raytrace/math/color.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// The way from points to a light, and what arrives along it where nothing is in between. Lights at a point or
/// infinitely far away are met by no direction that a BSDF draws: their radiance stands for the integral over solid
/// angle, as pbrt's delta lights have it.
template <class F>
struct LightSample {
  Vec3<F> to_light;  ///< of any length: a shadow ray along it ends at t_max
  F t_max;           ///< in multiples of to_light: 1 at the light's location, infinity for light from infinitely far
  Rgb<F> radiance;
};

}  // namespace raytrace
