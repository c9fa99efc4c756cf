// Perfectly diffuse reflection (Suffern, chapter 13): light leaves evenly to all sides.
#pragma once

#include <numbers>

#include "raytrace/math/color.h"
#include "raytrace/math/frame.h"
#include "raytrace/math/unit_disk.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// T: float, or a batch for lanes with different surfaces.
template <class T>
struct Lambertian {
  Rgb<T> reflectance;  ///< coefficient times colour

  /// The BRDF, without the cosine, in 1/steradian: reflectance / pi for all directions on the normal's side.
  Rgb<T> f() const { return reflectance * T(std::numbers::inv_pi_v<float>); }

  /// The share of light that is reflected, whatever its direction.
  const Rgb<T>& rho() const { return reflectance; }

  /// A direction wi for light to come from, out of u1, u2 in [0, 1), always on the normal's side; T is a batch.
  /// wo, normal: unit vectors that point away from the surface, in the frame that wi is wanted in.
  Vec3<T> sample(const Vec3<T>&, const Vec3<T>& normal, const T& u1, const T& u2) const {
    const DiskPoint<T> point = on_unit_disk(u1, u2);
    return Frame<T>(normal).to_world({point.x, point.y, sqrt(max(T(1) - point.x * point.x - point.y * point.y, T(0)))});
  }

  /// The density at which sample() draws wi, in 1/steradian (per solid angle): cos / pi. The cosine is in the density,
  /// not in f: f() cos / pdf() is the reflectance for every sample. 0 below the surface.
  T pdf(const Vec3<T>&, const Vec3<T>& wi, const Vec3<T>& normal) const {
    return max(dot(normal, wi), T(0)) * T(std::numbers::inv_pi_v<float>);
  }
};

}  // namespace raytrace
