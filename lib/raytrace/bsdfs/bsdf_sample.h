// A direction that a BSDF drew.
#pragma once

#include "raytrace/math/color.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// In the local frame of a surface point, where the normal is z and directions point away from the surface.
template <class T>
struct BsdfSample {
  Vec3<T> wi;  ///< unit length, where light comes from
  Rgb<T> f;    ///< of wo and wi, in 1/steradian, without the cosine; 0 below the surface
  T pdf;       ///< density of wi per solid angle: the mean of f wi.z / pdf is the share of light that is reflected
};

/// The normal in the local frame.
template <class T>
Vec3<T> local_normal() {
  return {T(0), T(0), T(1)};
}

}  // namespace raytrace
