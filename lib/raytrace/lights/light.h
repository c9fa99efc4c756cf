// What a light sends to a point.
//
// A light type provides, besides its Parameters and fields():
//   explicit Light(const Parameters&);
//   static constexpr bool ambient;   true: light from everywhere, never shadowed
// and, if it is ambient:
//   Rgb<float> radiance() const;
// else:
//   bool shadows() const;
//   Rgb<float> largest_radiance() const;   no point gets more
//   template <class F> LightSample<F> sample(const Vec3<F>& position) const;
// and, so that shadows are found sooner, one of these, where it holds:
//   Vec3f location() const;    to_light is location() - position, and end is 1
//   Vec3f direction() const;   to_light is direction(), of unit length, and end is infinity
#pragma once

#include "raytrace/math/color.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// The way from points to a light, and what arrives along it where nothing is in between.
template <class F>
struct LightSample {
  Vec3<F> to_light;  ///< of any length; a shadow ray along it ends at `end`
  F end;             ///< in multiples of to_light: 1 at the light's location, infinity for light from infinitely far
  Rgb<F> radiance;
};

}  // namespace raytrace
