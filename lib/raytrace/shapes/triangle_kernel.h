// Where rays meet triangles. In Embree's scene the intersection is Embree's own (its robust mode: no gaps between
// triangles that share an edge); the one here is for direction buffers, with the same answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/shapes/light_patch.h"
#include "raytrace/shapes/triangle.h"

namespace raytrace {

template <>
class Kernel<Triangle> {
 public:
  using Parameters = Triangle::Parameters;

  /// Also the layout of Embree's vertex buffer.
  template <class T>
  struct Record {
    Vec3<T> vertex1, vertex2, vertex3;
  };
  static Record<float> record(const Parameters& parameters);
  static void add_patches(const Record<float>& triangle, std::vector<LightPatch>& patches) {
    const Vec3d corner(triangle.vertex1);
    patches.push_back(
        {PatchShape::triangle, corner, Vec3d(triangle.vertex2) - corner, Vec3d(triangle.vertex3) - corner});
  }
  static Bounds bounds(const Record<float>& triangle);

  /// The distance inside (ray.near, ray.far) in each lane of `active`, infinity elsewhere, and the barycentric
  /// coordinates u of vertex 2, v of vertex 3. Rays do not pass between triangles that share an edge: both find the
  /// same on which side of it the ray is, and what is within rounding belongs to both. Plücker coordinates: Davidovič
  /// et al., "3D Rasterization: A Bridge between Rasterization and Ray Casting", Graphics Interface 2012.
  /// Rays: Ray<F> or RaysFromPoint<F>. T: float, or F where lanes have different triangles.
  template <class F, class T, class Rays>
  static F intersect(const Record<T>& triangle, const Rays& ray, const Mask<F>& active, F& u, F& v);

  /// The surface at barycentric coordinates: u of vertex 2, v of vertex 3.
  template <class F>
  static SurfacePoint<F> surface(const Record<F>& triangle, const F& u, const F& v);

  /// The barycentric coordinates, as they are.
  template <class F>
  static SurfaceUv<F> uv(const Record<F>& triangle, const F& u, const F& v) {
    return {u, v, triangle.vertex2 - triangle.vertex1, triangle.vertex3 - triangle.vertex1};
  }

  /// The surface's point on a ray that hits it, and its error.
  template <class F>
  static SurfacePosition<F> position_on_ray(const Record<F>& triangle, const Ray<F>& ray);

 private:
  /// Where rays meet the triangle's plane. T: float, or F where lanes have different triangles.
  template <class F, class T, class Origin>
  static Doubles<F> plane_distance(const Record<T>& triangle, const Vec3<Origin>& origin, const Vec3<F>& direction);
};

namespace detail {

/// With as few roundings as the instruction set allows.
template <class F>
RAYTRACE_INLINE Vec3<F> fused_cross(const Vec3<F>& a, const Vec3<F>& b) {
  return {multiply_add(a.y, b.z, -(a.z * b.y)), multiply_add(a.z, b.x, -(a.x * b.z)),
          multiply_add(a.x, b.y, -(a.y * b.x))};
}

}  // namespace detail

template <class F, class T, class Rays>
RAYTRACE_INLINE F Kernel<Triangle>::intersect(const Record<T>& triangle, const Rays& ray, const Mask<F>& active, F& u,
                                              F& v) {
  using Vector = std::remove_cvref_t<decltype(ray.origin)>;  // as wide as the origin is
  const Vector vertex1 = Vector(triangle.vertex1) - ray.origin;
  const Vector vertex2 = Vector(triangle.vertex2) - ray.origin;
  const Vector vertex3 = Vector(triangle.vertex3) - ray.origin;
  // Each edge and the ray as lines: their product, of which side of the edge the ray passes. An edge walked the other
  // way gives exactly the negative. The operations and their order are those of Embree's robust mode, so that a ray
  // meets the same triangles by either.
  const Vector edge31 = vertex3 - vertex1, edge12 = vertex1 - vertex2, edge23 = vertex2 - vertex3;
  const F opposite2 = fused_dot(Vec3<F>(detail::fused_cross(edge31, vertex3 + vertex1)), ray.direction);
  const F opposite3 = fused_dot(Vec3<F>(detail::fused_cross(edge12, vertex1 + vertex2)), ray.direction);
  const F opposite1 = fused_dot(Vec3<F>(detail::fused_cross(edge23, vertex2 + vertex3)), ray.direction);
  const F sum = opposite2 + opposite3 + opposite1;
  const F rounding = abs(sum) * F(0x1p-23f);
  const F least = min(min(opposite1, opposite2), opposite3);
  const F most = max(max(opposite1, opposite2), opposite3);
  const Mask<F> inside = active & ((least >= -rounding) | (most <= rounding));
  if (none(inside)) return infinity<F>();
  const Vector perpendicular = detail::fused_cross(edge31, edge12);
  const auto height = fused_dot(vertex1, perpendicular);
  F t = F(height) / fused_dot(Vec3<F>(perpendicular), ray.direction);
  // Again, in double, where the ray starts so close to the triangle's plane that little is left of its height, or the
  // triangle is so large or small that floats do not hold it: rays that leave a large triangle must not hit it.
  using std::abs;
  const auto terms =
      abs(vertex1.x * perpendicular.x) + abs(vertex1.y * perpendicular.y) + abs(vertex1.z * perpendicular.z);
  const F size(terms);
  const Mask<F> precise = (F(abs(height)) >= size * F(0x1p-10F)) & (size > F(1e-30F)) & (size < F(1e37F));
  const Mask<F> imprecise = inside & !precise;
  if (any(imprecise)) t = select(imprecise, plane_distance<F>(triangle, ray.origin, ray.direction).to_float(), t);
  const F inverse_sum = F(1) / sum;
  u = min(max(opposite2 * inverse_sum, F(0)), F(1));
  v = min(max(opposite3 * inverse_sum, F(0)), F(1));
  return select(inside & (t > ray.near) & (t < ray.far), t, infinity<F>());
}

template <class F>
SurfacePoint<F> Kernel<Triangle>::surface(const Record<F>& triangle, const F& u, const F& v) {
  Vec3<F> edge1 = triangle.vertex2 - triangle.vertex1;
  Vec3<F> edge2 = triangle.vertex3 - triangle.vertex1;
  const Vec3<F> position = triangle.vertex1 + edge1 * u + edge2 * v;
  const F size =
      max(max(max(abs(edge1.x), abs(edge1.y)), abs(edge1.z)), max(max(abs(edge2.x), abs(edge2.y)), abs(edge2.z)));
  // Edges of about length 1, by a power of 2: floats do not hold the squares of all areas.
  const F scale = inverse_power_of_2(size);
  edge1 = edge1 * scale;
  edge2 = edge2 * scale;
  // Embree's distance is off in proportion to the triangle's length over its altitude, as far as that exceeds 1.
  const Vec3<F> perpendicular = cross(edge1, edge2);
  const F inverse_area = F(1) / length(perpendicular);
  const F sliver = max(F(1), max(dot(edge1, edge1), dot(edge2, edge2)) * inverse_area);
  return {position, perpendicular * inverse_area, rounding_error(position, size) * sliver};
}

template <class F>
SurfacePosition<F> Kernel<Triangle>::position_on_ray(const Record<F>& triangle, const Ray<F>& ray) {
  using D = Doubles<F>;
  const D t = plane_distance<F>(triangle, ray.origin, ray.direction);
  const Vec3<F> position = to_float(Vec3<D>(ray.origin) + Vec3<D>(ray.direction) * t);
  return {position, rounding_error(position, F(0))};
}

template <class F, class T, class Origin>
Doubles<F> Kernel<Triangle>::plane_distance(const Record<T>& triangle, const Vec3<Origin>& origin,
                                            const Vec3<F>& direction) {
  using D = Doubles<F>;
  using Double = std::conditional_t<std::is_same_v<T, float>, double, D>;  // as wide as the triangle is
  const Vec3<Double> vertex1(triangle.vertex1);
  const Vec3<D> normal(cross(Vec3<Double>(triangle.vertex2) - vertex1, Vec3<Double>(triangle.vertex3) - vertex1));
  return dot(normal, Vec3<D>(vertex1) - Vec3<D>(Vec3<F>(origin))) / dot(normal, Vec3<D>(direction));
}

inline Kernel<Triangle>::Record<float> Kernel<Triangle>::record(const Parameters& parameters) {
  return {Vec3f(parameters.vertex1), Vec3f(parameters.vertex2), Vec3f(parameters.vertex3)};
}

inline Bounds Kernel<Triangle>::bounds(const Record<float>& triangle) {
  const auto& [a, b, c] = triangle;
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

}  // namespace raytrace
