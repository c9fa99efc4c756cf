// Where rays meet cylinders: solved in double, since the part of the ray along the axis cancels, and the axis may be
// long and thin. With caps it is a frustum.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/shapes/cylinder.h"
#include "raytrace/shapes/frustum.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

template <>
class Kernel<Cylinder> {
 public:
  using Parameters = Cylinder::Parameters;

  template <class T>
  struct Record {
    Vec3<T> bottom;
    Vec3<T> axis;  ///< unit length, from bottom to top
    T height;
    T radius;
    T caps;  ///< 1 if it has any, else 0
  };
  static Record<double> record(const Parameters& parameters);
  static void add_patches(const Record<double>& cylinder, std::vector<LightPatch>& patches) {
    add_frustum_patches({cylinder.bottom, cylinder.axis, cylinder.height, cylinder.radius, 0, cylinder.caps}, patches);
  }
  static Bounds bounds(const Record<double>& cylinder);
  static double bounding_radius(const Record<double>& cylinder);

  /// The nearest distance inside (ray.near, ray.far) in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& cylinder, const Ray<F>& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& cylinder, const Ray<F>& ray, const F& distance);

  /// u: the angle about the axis; v: along it, from bottom to top. On a cap v is the distance from the axis.
  template <class F>
  static SurfaceUv<F> uv(const Record<Doubles<F>>& cylinder, const Vec3<F>& position, const Vec3<F>& normal) {
    return frustum_uv<F>(frustum<Doubles<F>>(cylinder), position, normal);
  }

 private:
  /// N: double or D; D: Doubles.
  template <class D, class N>
  static Frustum<D> frustum(const Record<N>& cylinder) {
    return {Vec3<D>(cylinder.bottom), Vec3<D>(cylinder.axis), D(cylinder.height), D(cylinder.radius), D(0.0),
            D(cylinder.caps)};
  }
  template <class D, class N, class F>
  static FrustumRay<D> frustum_ray(const Record<N>& cylinder, const Ray<F>& ray) {
    return {frustum<D>(cylinder), Vec3<D>(ray.origin), Vec3<D>(ray.direction)};
  }
  template <class F>
  static F intersect_closed(const Record<double>& cylinder, const Ray<F>& ray) {
    using D = Doubles<F>;
    return frustum_ray<D>(cylinder, ray).nearest(true, D(ray.near), D(ray.far)).to_float();
  }
};

template <class F>
RAYTRACE_INLINE F Kernel<Cylinder>::intersect(const Record<double>& cylinder, const Ray<F>& ray,
                                              const Mask<F>& active) {
  using D = Doubles<F>;
  if (cylinder.caps > 0) return select(active, intersect_closed(cylinder, ray), infinity<F>());
  const Vec3<D> axis(cylinder.axis);
  const Vec3<D> from_bottom = Vec3<D>(ray.origin) - Vec3<D>(cylinder.bottom);
  const Vec3<D> d(ray.direction);
  // Along the axis, and across it, where the cylinder is a circle.
  const D height_at_origin = dot(from_bottom, axis);
  const D climb = dot(d, axis);
  const Vec3<D> across = from_bottom - axis * height_at_origin;
  const Vec3<D> d_across = d - axis * climb;
  const D a = dot(d_across, d_across);
  const D inverse_a = D(1.0) / a;  // infinite for a ray along the axis: the comparisons below then fail
  const D to_closest = -dot(across, d_across) * inverse_a;
  const Vec3<D> closest = across + d_across * to_closest;
  const D radius(cylinder.radius);
  const D discriminant = radius * radius - dot(closest, closest);
  Mask<D> possible = discriminant >= D(0.0);
  if (none(active & D::float_mask(possible))) return infinity<F>();

  const D half_chord = sqrt(max(discriminant, D(0.0)) * inverse_a);
  const D entry = to_closest - half_chord, exit = to_closest + half_chord;
  const D near(ray.near), far(ray.far), zero(0.0), height(cylinder.height);
  const auto inside = [&](const D& t) {
    const D h = multiply_add(climb, t, height_at_origin);
    return (h >= zero) & (h <= height) & (t > near) & (t < far);
  };
  const auto hit_entry = possible & inside(entry);
  const auto hit_exit = possible & inside(exit);
  const D miss(std::numeric_limits<double>::infinity());
  const F t = select(hit_entry, entry, select(hit_exit, exit, miss)).to_float();
  return select(active, t, infinity<F>());
}

template <class F>
SurfacePoint<F> Kernel<Cylinder>::surface(const Record<Doubles<F>>& cylinder, const Ray<F>& ray, const F& distance) {
  using D = Doubles<F>;
  const Vec3<D> from_bottom = Vec3<D>(ray.origin) - cylinder.bottom + Vec3<D>(ray.direction) * D(distance);
  const D height = dot(from_bottom, cylinder.axis);
  const Vec3<D> normal = normalize(from_bottom - cylinder.axis * height);
  const Vec3<D> on_surface = cylinder.bottom + cylinder.axis * height + normal * cylinder.radius;
  const Vec3<F> position = to_float(on_surface);
  const SurfacePoint<F> side{position, to_float(normal), rounding_error(position, F(0))};
  const auto has_caps = cylinder.caps > D(0.0);
  if (!any(has_caps)) return side;
  return select(D::float_mask(has_caps), frustum_ray<D>(cylinder, ray).template surface<F>(D(distance)), side);
}

inline Kernel<Cylinder>::Record<double> Kernel<Cylinder>::record(const Parameters& parameters) {
  const Vec3d span = parameters.top - parameters.bottom;
  return {parameters.bottom, normalize(span), length(span), parameters.radius, parameters.caps ? 1.0 : 0.0};
}

inline Bounds Kernel<Cylinder>::bounds(const Record<double>& cylinder) {
  // The box of the two rims: a circle around `axis` reaches radius * sqrt(1 - axis_i^2) along axis i.
  const Vec3d& axis = cylinder.axis;
  const double half_height = cylinder.height / 2;
  const auto reach = [&](double axis_i) {
    return std::abs(axis_i) * half_height + cylinder.radius * std::sqrt(std::max(0.0, 1 - axis_i * axis_i));
  };
  return bounds_around(cylinder.bottom + axis * half_height, {reach(axis.x), reach(axis.y), reach(axis.z)});
}

inline double Kernel<Cylinder>::bounding_radius(const Record<double>& cylinder) {
  return std::hypot(cylinder.height / 2, cylinder.radius);
}

}  // namespace raytrace
