// Where rays meet toruses; the root finding is in torus_ray.h.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/shapes/light_patch.h"
#include "raytrace/shapes/torus.h"
#include "raytrace/shapes/torus_ray.h"

namespace raytrace {

template <>
class Kernel<Torus> {
 public:
  using Parameters = Torus::Parameters;

  template <class T>
  struct Record {
    Vec3<T> center;
    Vec3<T> axis;  ///< unit length
    T swept, tube;
  };
  static Record<double> record(const Parameters& parameters);
  static void add_patches(const Record<double>& torus, std::vector<LightPatch>& patches) {
    patches.push_back({PatchShape::torus, torus.center, torus.axis, {torus.swept, torus.tube, 0}});
  }
  static Bounds bounds(const Record<double>& torus);
  static double bounding_radius(const Record<double>& torus);

  /// The nearest distance inside (ray.near, ray.far) in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& torus, const Ray<F>& ray, const Mask<F>& active);

  /// Whether anything lies inside (ray.near, ray.far): where it is takes no part of the answer.
  template <class F>
  static Mask<F> occludes(const Record<double>& torus, const Ray<F>& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& torus, const Ray<F>& ray, const F& distance);

  /// u: the angle about the axis; v: the angle around the tube, from the hole's side (0) below, outside (1/2) and
  /// above.
  template <class F>
  static SurfaceUv<F> uv(const Record<Doubles<F>>& torus, const Vec3<F>& position, const Vec3<F>&);

 private:
  /// From the center to that of the tube's circle through a point: on either side of the axis where the tube is wider
  /// than its hole.
  template <class D>
  static Vec3<D> tube_center(const Record<D>& torus, const Vec3<D>& from_center);
};

template <class F>
F Kernel<Torus>::intersect(const Record<double>& torus, const Ray<F>& ray, const Mask<F>& active) {
  if (none(active & comes_near(torus, ray))) return infinity<F>();
  // Of the whole ray: what it has hit so far must not change the digits of what it hits here.
  const TorusRay<F> places(torus, {ray.origin, ray.direction, ray.near, infinity<F>()});
  auto bracket = places.first_root(active);
  bracket.found = bracket.found & places.begins_before(bracket, ray.far);
  if (none(bracket.found)) return infinity<F>();
  const F t = places.distance(bracket);
  return select(bracket.found & (t > ray.near) & (t < ray.far), t, infinity<F>());
}

template <class F>
Mask<F> Kernel<Torus>::occludes(const Record<double>& torus, const Ray<F>& ray, const Mask<F>& active) {
  if (none(active & comes_near(torus, ray))) return Mask<F>(false);
  return TorusRay<F>(torus, ray).first_root(active).found;
}

template <class F>
SurfacePoint<F> Kernel<Torus>::surface(const Record<Doubles<F>>& torus, const Ray<F>& ray, const F& distance) {
  using D = Doubles<F>;
  const Vec3<D> p = Vec3<D>(ray.origin) - torus.center + Vec3<D>(ray.direction) * D(distance);
  const Vec3<D> middle = tube_center(torus, p);
  const Vec3<D> normal = normalize(p - middle);
  const Vec3<F> position = to_float(torus.center + middle + normal * torus.tube);
  return {position, to_float(normal), rounding_error(position, F(0))};
}

template <class F>
SurfaceUv<F> Kernel<Torus>::uv(const Record<Doubles<F>>& torus, const Vec3<F>& position, const Vec3<F>&) {
  using D = Doubles<F>;
  const Vec3<D> p = Vec3<D>(position) - torus.center;
  const Vec3<D> middle = tube_center(torus, p);
  const Vec3<F> axis = to_float(torus.axis), from_middle = to_float(p - middle);
  const Vec3<F> out = to_float(middle * (D(1.0) / torus.swept));
  const F above = dot(from_middle, axis), outside = dot(from_middle, out);
  return {turns_about(axis, out), turns(above, outside) + F(0.5F), cross(axis, to_float(p)) * F(one_turn),
          (axis * outside - out * above) * F(one_turn)};
}

template <class D>
RAYTRACE_INLINE Vec3<D> Kernel<Torus>::tube_center(const Record<D>& torus, const Vec3<D>& from_center) {
  const D y = dot(from_center, torus.axis);
  const Vec3<D> across = from_center - torus.axis * y;
  const D rho = max(length(across), D(1e-300));
  const auto off_sheet = [&](const D& swept) {
    return abs((rho - swept) * (rho - swept) + (y - torus.tube) * (y + torus.tube));
  };
  const D swept = select(off_sheet(torus.swept) <= off_sheet(-torus.swept), torus.swept, -torus.swept);
  return across * (swept / rho);
}

inline Kernel<Torus>::Record<double> Kernel<Torus>::record(const Parameters& parameters) {
  return {parameters.center, normalize(parameters.axis), parameters.sweptradius, parameters.tuberadius};
}

inline Bounds Kernel<Torus>::bounds(const Record<double>& torus) {
  // A circle around `axis` reaches swept * sqrt(1 - axis_i^2) along axis i, and the tube its radius further.
  const auto reach = [&](double axis_i) {
    return torus.swept * std::sqrt(std::max(0.0, 1 - axis_i * axis_i)) + torus.tube;
  };
  return bounds_around(torus.center, {reach(torus.axis.x), reach(torus.axis.y), reach(torus.axis.z)});
}

inline double Kernel<Torus>::bounding_radius(const Record<double>& torus) { return torus.swept + torus.tube; }

}  // namespace raytrace
