// Where rays meet disks.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/shapes/disk.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

template <>
class Kernel<Disk> {
 public:
  using Parameters = Disk::Parameters;

  template <class T>
  struct Record {
    Vec3<T> center;
    Vec3<T> normal;  ///< unit length
    T radius;
  };
  static Record<double> record(const Parameters& parameters);
  static void add_patches(const Record<double>& disk, std::vector<LightPatch>& patches) {
    patches.push_back({PatchShape::band, disk.center, disk.normal, {disk.radius, 0, 0}});
  }
  static Bounds bounds(const Record<double>& disk);
  static double bounding_radius(const Record<double>& disk);

  /// The distance if it is inside (ray.near, ray.far), in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& disk, const Ray<F>& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& disk, const Ray<F>& ray, const F& distance);

  /// u: the angle about the normal; v: the distance from the center, 1 at the rim.
  template <class F>
  static SurfaceUv<F> uv(const Record<Doubles<F>>& disk, const Vec3<F>& position, const Vec3<F>&) {
    return ring_uv(to_float(disk.normal), to_float(Vec3<Doubles<F>>(position) - disk.center), F(0),
                   disk.radius.to_float());
  }
};

template <class F>
RAYTRACE_INLINE F Kernel<Disk>::intersect(const Record<double>& disk, const Ray<F>& ray, const Mask<F>& active) {
  using D = Doubles<F>;
  const Vec3<D> normal(disk.normal), d(ray.direction);
  const Vec3<D> to_center = Vec3<D>(disk.center) - Vec3<D>(ray.origin);
  const D t = dot(normal, to_center) / dot(normal, d);  // a ray in the disk's plane gives infinity or NaN: no hit
  const Vec3<D> from_center = d * t - to_center;
  const D radius(disk.radius);
  const auto hit = (dot(from_center, from_center) <= radius * radius) & (t > D(ray.near)) & (t < D(ray.far));
  return select(active & D::float_mask(hit), t.to_float(), infinity<F>());
}

template <class F>
SurfacePoint<F> Kernel<Disk>::surface(const Record<Doubles<F>>& disk, const Ray<F>& ray, const F& distance) {
  using D = Doubles<F>;
  const Vec3<D> from_center = Vec3<D>(ray.origin) + Vec3<D>(ray.direction) * D(distance) - disk.center;
  const Vec3<F> position = to_float(disk.center + from_center - disk.normal * dot(disk.normal, from_center));
  return {position, to_float(disk.normal), rounding_error(position, F(0))};
}

inline Kernel<Disk>::Record<double> Kernel<Disk>::record(const Parameters& parameters) {
  return {parameters.center, normalize(parameters.normal), parameters.radius};
}

inline Bounds Kernel<Disk>::bounds(const Record<double>& disk) {
  // A circle across `normal` reaches radius * sqrt(1 - normal_i^2) along axis i.
  const auto reach = [&](double normal_i) { return disk.radius * std::sqrt(std::max(0.0, 1 - normal_i * normal_i)); };
  return bounds_around(disk.center, {reach(disk.normal.x), reach(disk.normal.y), reach(disk.normal.z)});
}

inline double Kernel<Disk>::bounding_radius(const Record<double>& disk) { return disk.radius; }

}  // namespace raytrace
