// Flat disk (Suffern, chapter 19.3): the part of a plane within a radius of its center.
//
//   <disk> <center x="0" y="1" z="0"/> <normal x="0" y="1" z="0"/> <radius>0.5</radius> <material>red</material>
//   </disk>
//
// docs/how-to-add-a-type.md walks through this pair of files.
#pragma once

#include <cmath>

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/ray.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class Disk {
 public:
  struct Parameters {
    Vec3d center{};
    Vec3d normal{};  ///< of any length but 0; either side is shaded
    double radius = 0;
  };
  static constexpr std::string_view group = "disks";
  static constexpr std::string_view element = "disk";
  static Fields<Parameters> fields();

  template <class T>
  struct Record {
    Vec3<T> center;
    Vec3<T> normal;  ///< unit length
    T radius;
  };
  static Record<double> record(const Parameters& parameters);
  static Bounds bounds(const Record<double>& disk);
  static double bounding_radius(const Record<double>& disk);

  /// The distance if it is inside (ray.near, ray.far), in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& disk, const Ray<F>& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& disk, const Ray<F>& ray, const F& distance);
};

template <class F>
RAYTRACE_INLINE F Disk::intersect(const Record<double>& disk, const Ray<F>& ray, const Mask<F>& active) {
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
SurfacePoint<F> Disk::surface(const Record<Doubles<F>>& disk, const Ray<F>& ray, const F& distance) {
  using D = Doubles<F>;
  const Vec3<D> from_center = Vec3<D>(ray.origin) + Vec3<D>(ray.direction) * D(distance) - disk.center;
  const Vec3<F> position = to_float(disk.center + from_center - disk.normal * dot(disk.normal, from_center));
  return {position, to_float(disk.normal), rounding_error(position, F(0))};
}

}  // namespace raytrace
