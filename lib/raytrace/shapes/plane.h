// Infinite plane (Suffern, chapter 3).
//
//   <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>floor</material> </plane>
//
// It has no bounds(), and so stays out of the BVH. Distances are computed in double: far from the origin, or at the
// horizon, both terms of the quotient cancel. Not so where the plane faces along an axis, as floors and walls do: there
// is one difference of two floats to take.
#pragma once

#include <cmath>

#include "raytrace/description/fields.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

class Plane {
 public:
  struct Parameters {
    Vec3d point{};   ///< any point on the plane
    Vec3d normal{};  ///< of any length but 0; either side is shaded
  };
  static constexpr std::string_view group = "planes";
  static constexpr std::string_view element = "plane";
  static Fields<Parameters> fields();

  template <class T>
  struct Record {
    Vec3<T> normal;  ///< unit length
    T offset;        ///< dot(normal, any point of the plane)
  };
  static Record<double> record(const Parameters& parameters);

  /// The distance if it is inside (ray.near, ray.far), in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& plane, const Ray<F>& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<double>& plane, const Ray<F>& ray, const F& distance);

 private:
  /// Of the axis that the normal lies along: 0, 1 or 2; 3 if it lies along none.
  static int axis(const Record<double>& plane) {
    const Vec3<double>& normal = plane.normal;
    if (normal.y == 0 && normal.z == 0) return 0;
    if (normal.x == 0 && normal.z == 0) return 1;
    if (normal.x == 0 && normal.y == 0) return 2;
    return 3;
  }
};

template <class F>
RAYTRACE_INLINE F Plane::intersect(const Record<double>& plane, const Ray<F>& ray, const Mask<F>& active) {
  F height, speed;
  if (const int along = axis(plane); along < 3) {
    const double place = plane.offset * component(plane.normal, along);
    const auto rounded = static_cast<float>(place), rest = static_cast<float>(place - rounded);
    height = (F(rounded) - component(ray.origin, along)) + F(rest);
    speed = component(ray.direction, along);
  } else {
    using D = Doubles<F>;
    const Vec3<D> normal(plane.normal);
    height = (D(plane.offset) - dot(normal, Vec3<D>(ray.origin))).to_float();
    speed = dot(normal, Vec3<D>(ray.direction)).to_float();
  }
  const F t = height / speed;  // a ray in the plane gives infinity or NaN: no hit
  return select(active & (t > ray.near) & (t < ray.far), t, infinity<F>());
}

template <class F>
SurfacePoint<F> Plane::surface(const Record<double>& plane, const Ray<F>& ray, const F& distance) {
  const int along = axis(plane);
  if (along == 3) {
    using D = Doubles<F>;
    const Vec3<D> normal(plane.normal);
    const Vec3<D> on_ray = Vec3<D>(ray.origin) + Vec3<D>(ray.direction) * D(distance);
    const Vec3<F> position = to_float(on_ray + normal * (D(plane.offset) - dot(normal, on_ray)));
    return {position, Vec3<F>(Vec3f(plane.normal)), rounding_error(position, F(0))};
  }
  const F place(static_cast<float>(plane.offset * component(plane.normal, along)));
  const Vec3<F> on_ray = ray.at(distance);
  const Vec3<F> position{along == 0 ? place : on_ray.x, along == 1 ? place : on_ray.y, along == 2 ? place : on_ray.z};
  return {position, Vec3<F>(Vec3f(plane.normal)), rounding_error(position, F(0))};
}

}  // namespace raytrace
