// Where rays meet boxes: in double, so that what passes an edge closely from far away is on the right side of it.
#pragma once

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/shapes/box.h"

namespace raytrace {

template <>
class Kernel<Box> {
 public:
  using Parameters = Box::Parameters;

  template <class T>
  struct Record {
    Vec3<T> min, max;
  };
  static Record<double> record(const Parameters& parameters) { return {parameters.min, parameters.max}; }
  static Bounds bounds(const Record<double>& box) {
    return bounds_around((box.min + box.max) * 0.5, (box.max - box.min) * 0.5);
  }

  /// The nearest distance inside (ray.near, ray.far) in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& box, const Ray<F>& ray, const Mask<F>& active) {
    using D = Doubles<F>;
    const Slabs<D> slabs({Vec3<D>(box.min), Vec3<D>(box.max)}, Vec3<D>(ray.origin), Vec3<D>(ray.direction));
    const D near(ray.near), t = select(slabs.last_entry > near, slabs.last_entry, slabs.first_exit);
    const auto hit = (slabs.last_entry <= slabs.first_exit) & (t > near) & (t < D(ray.far));
    return select(active & D::float_mask(hit), t.to_float(), infinity<F>());
  }

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& box, const Ray<F>& ray, const F& distance) {
    using D = Doubles<F>;
    const Vec3<D> origin(ray.origin), direction(ray.direction);
    const Slabs<D> slabs(box, origin, direction);
    const D zero(0.0), one(1.0), at(distance);
    const auto leaves = abs(slabs.first_exit - at) < abs(slabs.last_entry - at);
    const Vec3<D> faces = select(leaves, slabs.exit, slabs.entry);
    const D face = select(leaves, slabs.first_exit, slabs.last_entry);
    const auto clamp = [](const D& x, const D& low, const D& high) { return min(max(x, low), high); };
    const Vec3<D> on_ray = origin + direction * at;
    Vec3<D> position(clamp(on_ray.x, box.min.x, box.max.x), clamp(on_ray.y, box.min.y, box.max.y),
                     clamp(on_ray.z, box.min.z, box.max.z));
    // On the first axis whose face it is, at the end that the ray goes to if it leaves.
    const auto x = (faces.x >= face) & (faces.x <= face), y = (faces.y >= face) & (faces.y <= face);
    const Vec3<D> speed = select(leaves, direction, -direction);
    const auto end = [&](const D& s, const D& low, const D& high) { return select(s > zero, high, low); };
    const Vec3<D> normal(select(x, one, zero), select(x, zero, select(y, one, zero)),
                         select(x, zero, select(y, zero, one)));
    position.x = select(normal.x > zero, end(speed.x, box.min.x, box.max.x), position.x);
    position.y = select(normal.y > zero, end(speed.y, box.min.y, box.max.y), position.y);
    position.z = select(normal.z > zero, end(speed.z, box.min.z, box.max.z), position.z);
    const Vec3<F> rounded = to_float(position);
    const Vec3<D> outwards = select(dot(normal, speed) > zero, normal, -normal);
    return {rounded, to_float(outwards), rounding_error(rounded, F(0))};
  }

  /// Over each face once: to the right and up, as one looks at it (math/surface_uv.h).
  template <class F>
  static SurfaceUv<F> uv(const Record<Doubles<F>>& box, const Vec3<F>& position, const Vec3<F>& normal) {
    using D = Doubles<F>;
    const Vec3<D> p(position);
    const Vec3<F> size = to_float(box.max - box.min), from_min = to_float(p - box.min);
    const auto outwards = [](const F& n, const F& s, const F& q) {
      return select(abs(n) > F(0.5F), select(q + q > s, F(1), F(-1)), F(0));
    };
    const Vec3<F> out(outwards(normal.x, size.x, from_min.x), outwards(normal.y, size.y, from_min.y),
                      outwards(normal.z, size.z, from_min.z));
    const TangentFrame<F> frame(out);
    const auto along = [&](const Vec3<F>& axis, F& coordinate, Vec3<F>& derivative) {
      const F extent = abs(dot(axis, size)), at = dot(axis, from_min) / extent;
      coordinate = select(axis.x + axis.y + axis.z < F(0), at + F(1), at);
      derivative = axis * extent;
    };
    SurfaceUv<F> result{};
    along(frame.right, result.u, result.dpdu);
    along(frame.up, result.v, result.dpdv);
    return result;
  }

 private:
  /// Where a ray is between the planes of each two faces, and where between all.
  template <class D>
  struct Slabs {
    Vec3<D> entry, exit;
    D last_entry, first_exit;

    RAYTRACE_INLINE Slabs(const Record<D>& box, const Vec3<D>& origin, const Vec3<D>& direction) {
      const auto along = [](const D& low, const D& high, const D& from, const D& speed, D& first, D& second) {
        const D slowest(1e-200);  // so that a ray along a face gives large numbers, and no 0 / 0
        const D inverse = D(1.0) / select(abs(speed) < slowest, slowest, speed);
        const D to_low = (low - from) * inverse, to_high = (high - from) * inverse;
        first = min(to_low, to_high);
        second = max(to_low, to_high);
      };
      along(box.min.x, box.max.x, origin.x, direction.x, entry.x, exit.x);
      along(box.min.y, box.max.y, origin.y, direction.y, entry.y, exit.y);
      along(box.min.z, box.max.z, origin.z, direction.z, entry.z, exit.z);
      last_entry = max(max(entry.x, entry.y), entry.z);
      first_exit = min(min(exit.x, exit.y), exit.z);
    }
  };
};

}  // namespace raytrace
