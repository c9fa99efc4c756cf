// Where rays meet annuli.
#pragma once

#include "raytrace/shapes/annulus.h"
#include "raytrace/shapes/disk_kernel.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

template <>
class Kernel<Annulus> {
 public:
  using Parameters = Annulus::Parameters;

  template <class T>
  struct Record {
    Kernel<Disk>::Record<T> disk;  ///< without the hole
    T inner;
  };
  static Record<double> record(const Parameters& parameters) {
    return {Kernel<Disk>::record({parameters.center, parameters.normal, parameters.outerradius}),
            parameters.innerradius};
  }
  static void add_patches(const Record<double>& annulus, std::vector<LightPatch>& patches) {
    const Kernel<Disk>::Record<double>& disk = annulus.disk;
    patches.push_back({PatchShape::band, disk.center, disk.normal, {disk.radius, annulus.inner, 0}});
  }
  static Bounds bounds(const Record<double>& annulus) { return Kernel<Disk>::bounds(annulus.disk); }
  static double bounding_radius(const Record<double>& annulus) { return annulus.disk.radius; }

  /// The distance if it is inside (ray.near, ray.far), in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& annulus, const Ray<F>& ray, const Mask<F>& active) {
    using D = Doubles<F>;
    const Vec3<D> normal(annulus.disk.normal), d(ray.direction);
    const Vec3<D> to_center = Vec3<D>(annulus.disk.center) - Vec3<D>(ray.origin);
    const D t = dot(normal, to_center) / dot(normal, d);  // a ray in its plane gives infinity or NaN: no hit
    const Vec3<D> from_center = d * t - to_center;
    const D inner(annulus.inner), outer(annulus.disk.radius), distance2 = dot(from_center, from_center);
    const auto hit = (distance2 >= inner * inner) & (distance2 <= outer * outer) & (t > D(ray.near)) & (t < D(ray.far));
    return select(active & D::float_mask(hit), t.to_float(), infinity<F>());
  }

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& annulus, const Ray<F>& ray, const F& distance) {
    return Kernel<Disk>::surface(annulus.disk, ray, distance);
  }

  /// u: the angle about the normal; v: from the inner rim to the outer one.
  template <class F>
  static SurfaceUv<F> uv(const Record<Doubles<F>>& annulus, const Vec3<F>& position, const Vec3<F>&) {
    return ring_uv(to_float(annulus.disk.normal), to_float(Vec3<Doubles<F>>(position) - annulus.disk.center),
                   annulus.inner.to_float(), annulus.disk.radius.to_float());
  }
};

}  // namespace raytrace
