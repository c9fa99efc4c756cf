// Where rays meet planes.
//
// A plane has no bounds(), and so stays out of the BVH. Distances are computed in double: far from the origin, or at
// the horizon, both terms of the quotient cancel. Not so where the plane faces along an axis, as floors and walls do:
// there is one difference of two floats to take.
#pragma once

#include <cmath>

#include "raytrace/math/doubles.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/shapes/plane.h"

namespace raytrace {

template <>
class Kernel<Plane> {
 public:
  using Parameters = Plane::Parameters;

  struct Record {
    Vec3d normal;      ///< unit length
    double offset;     ///< dot(normal, any point of the plane)
    int axis;          ///< that the normal lies along: 0, 1 or 2; 3 if it lies along none
    float coordinate;  ///< on that axis, rounded,
    float rest;        ///< and what is missing
  };
  static Record record(const Parameters& parameters);

  /// The distance if it is inside (ray.near, ray.far), in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record& plane, const Ray<F>& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record& plane, const Ray<F>& ray, const F& distance);

  /// In units of the world, to the right and up (math/surface_uv.h).
  template <class F>
  static SurfaceUv<F> uv(const Record& plane, const Vec3<F>& position, const Vec3<F>&) {
    const TangentFrame<F> frame{Vec3<F>(Vec3f(plane.normal))};
    return {dot(frame.right, position), dot(frame.up, position), frame.right, frame.up};
  }
};

template <class F>
RAYTRACE_INLINE F Kernel<Plane>::intersect(const Record& plane, const Ray<F>& ray, const Mask<F>& active) {
  F height, speed;
  if (plane.axis < 3) {
    height = (F(plane.coordinate) - component(ray.origin, plane.axis)) + F(plane.rest);
    speed = component(ray.direction, plane.axis);
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
RAYTRACE_INLINE SurfacePoint<F> Kernel<Plane>::surface(const Record& plane, const Ray<F>& ray, const F& distance) {
  if (plane.axis == 3) {
    using D = Doubles<F>;
    const Vec3<D> normal(plane.normal);
    const Vec3<D> on_ray = Vec3<D>(ray.origin) + Vec3<D>(ray.direction) * D(distance);
    const Vec3<F> position = to_float(on_ray + normal * (D(plane.offset) - dot(normal, on_ray)));
    return {position, Vec3<F>(Vec3f(plane.normal)), rounding_error(position, F(0))};
  }
  Vec3<F> position = ray.at(distance);
  component(position, plane.axis) = F(plane.coordinate);
  return {position, Vec3<F>(Vec3f(plane.normal)), rounding_error(position, F(0))};
}

inline Kernel<Plane>::Record Kernel<Plane>::record(const Parameters& parameters) {
  Record plane{};
  plane.normal = normalize(parameters.normal);
  plane.offset = dot(plane.normal, parameters.point);
  const Vec3d& normal = plane.normal;
  plane.axis = normal.y == 0 && normal.z == 0   ? 0
               : normal.x == 0 && normal.z == 0 ? 1
               : normal.x == 0 && normal.y == 0 ? 2
                                                : 3;
  if (plane.axis < 3) {
    const double coordinate = plane.offset * component(normal, plane.axis);
    plane.coordinate = static_cast<float>(coordinate);
    plane.rest = static_cast<float>(coordinate - double{plane.coordinate});
  }
  return plane;
}

}  // namespace raytrace
