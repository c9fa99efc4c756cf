// Where rays meet cones; the solving is in frustum.h.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/math/bounds.h"
#include "raytrace/math/kernel.h"
#include "raytrace/shapes/cone.h"
#include "raytrace/shapes/frustum.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

template <>
class Kernel<Cone> {
 public:
  using Parameters = Cone::Parameters;

  template <class T>
  struct Record : Frustum<T> {};

  static Record<double> record(const Parameters& parameters) {
    const Vec3d span = parameters.top - parameters.bottom;
    const double height = length(span);
    return {{parameters.bottom, normalize(span), height, parameters.radius,
             (parameters.topradius - parameters.radius) / height, parameters.caps ? 1.0 : 0.0}};
  }

  static void add_patches(const Record<double>& cone, std::vector<LightPatch>& patches) {
    add_frustum_patches(cone, patches);
  }
  static Bounds bounds(const Record<double>& cone) {
    // Of the two rims: a circle across the axis reaches radius * sqrt(1 - axis_i^2) along axis i.
    const auto rim = [&](double height) {
      const double radius = cone.radius + cone.widening * height;
      const auto reach = [&](double axis_i) { return radius * std::sqrt(std::max(0.0, 1 - axis_i * axis_i)); };
      return bounds_around(cone.bottom + cone.axis * height,
                           {reach(cone.axis.x), reach(cone.axis.y), reach(cone.axis.z)});
    };
    return join(rim(0), rim(cone.height));
  }

  /// The nearest distance inside (ray.near, ray.far) in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& cone, const Ray<F>& ray, const Mask<F>& active) {
    using D = Doubles<F>;
    const Frustum<D> frustum = {Vec3<D>(cone.bottom), Vec3<D>(cone.axis), D(cone.height),
                                D(cone.radius),       D(cone.widening),   D(cone.caps)};
    const FrustumRay<D> along(frustum, Vec3<D>(ray.origin), Vec3<D>(ray.direction));
    const F t = along.nearest(cone.caps > 0, D(ray.near), D(ray.far)).to_float();
    return select(active, t, infinity<F>());
  }

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& cone, const Ray<F>& ray, const F& distance) {
    using D = Doubles<F>;
    return FrustumRay<D>(cone, Vec3<D>(ray.origin), Vec3<D>(ray.direction)).template surface<F>(D(distance));
  }

  /// As those of cylinders.
  template <class F>
  static SurfaceUv<F> uv(const Record<Doubles<F>>& cone, const Vec3<F>& position, const Vec3<F>& normal) {
    return frustum_uv<F>(cone, position, normal);
  }
};

}  // namespace raytrace
