// Where rays meet rectangles.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/shapes/light_patch.h"
#include "raytrace/shapes/rectangle.h"

namespace raytrace {

template <>
class Kernel<Rectangle> {
 public:
  using Parameters = Rectangle::Parameters;

  template <class T>
  struct Record {
    Vec3<T> corner;
    Vec3<T> normal;  ///< unit length
    /// Of a point of the plane, less the corner: their dot products with it are its coordinates along the edges, in [0,
    /// 1] inside.
    Vec3<T> along1, along2;
  };

  static Record<double> record(const Parameters& parameters) {
    const Vec3d &a = parameters.edge1, &b = parameters.edge2;
    const Vec3d normal = cross(a, b);
    const double area2 = dot(normal, normal);
    return {parameters.corner, normalize(normal), cross(b, normal) * (1 / area2), cross(normal, a) * (1 / area2)};
  }

  static void add_patches(const Record<double>& rectangle, std::vector<LightPatch>& patches) {
    const Edges<double> edges(rectangle);
    patches.push_back({PatchShape::parallelogram, rectangle.corner, edges.first, edges.second});
  }
  static Bounds bounds(const Record<double>& rectangle) {
    const Edges<double> edges(rectangle);
    const auto reach = [](double a, double b) { return (std::abs(a) + std::abs(b)) / 2; };
    return bounds_around(rectangle.corner + (edges.first + edges.second) * 0.5,
                         {reach(edges.first.x, edges.second.x), reach(edges.first.y, edges.second.y),
                          reach(edges.first.z, edges.second.z)});
  }

  static double bounding_radius(const Record<double>& rectangle) {
    const Edges<double> edges(rectangle);
    return std::max(length(edges.first + edges.second), length(edges.first - edges.second)) / 2;
  }

  /// The distance if it is inside (ray.near, ray.far), in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& rectangle, const Ray<F>& ray, const Mask<F>& active) {
    using D = Doubles<F>;
    const Vec3<D> normal(rectangle.normal), d(ray.direction);
    const Vec3<D> to_corner = Vec3<D>(rectangle.corner) - Vec3<D>(ray.origin);
    const D t = dot(normal, to_corner) / dot(normal, d);  // a ray in the plane gives infinity or NaN: no hit
    const Vec3<D> from_corner = d * t - to_corner;
    const D u = dot(Vec3<D>(rectangle.along1), from_corner), v = dot(Vec3<D>(rectangle.along2), from_corner);
    const D zero(0.0), one(1.0);
    const auto hit = (u >= zero) & (u <= one) & (v >= zero) & (v <= one) & (t > D(ray.near)) & (t < D(ray.far));
    return select(active & D::float_mask(hit), t.to_float(), infinity<F>());
  }

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& rectangle, const Ray<F>& ray, const F& distance) {
    using D = Doubles<F>;
    const Vec3<D> from_corner = Vec3<D>(ray.origin) + Vec3<D>(ray.direction) * D(distance) - rectangle.corner;
    const Vec3<F> position =
        to_float(rectangle.corner + from_corner - rectangle.normal * dot(rectangle.normal, from_corner));
    return {position, to_float(rectangle.normal), rounding_error(position, F(0))};
  }

  /// u along the first edge, v along the second.
  template <class F>
  static SurfaceUv<F> uv(const Record<Doubles<F>>& rectangle, const Vec3<F>& position, const Vec3<F>&) {
    using D = Doubles<F>;
    const Vec3<D> from_corner = Vec3<D>(position) - rectangle.corner;
    const Edges<D> edges(rectangle);
    return {dot(rectangle.along1, from_corner).to_float(), dot(rectangle.along2, from_corner).to_float(),
            to_float(edges.first), to_float(edges.second)};
  }

 private:
  /// The edges, from the vectors along them.
  template <class T>
  struct Edges {
    Vec3<T> first, second;
    explicit Edges(const Record<T>& rectangle) {
      const Vec3<T>&a = rectangle.along1, &b = rectangle.along2;
      const Vec3<T> across = cross(a, b);
      const T scale = T(1.0) / dot(across, across);
      first = cross(b, across) * scale;
      second = cross(across, a) * scale;
    }
  };
};

}  // namespace raytrace
