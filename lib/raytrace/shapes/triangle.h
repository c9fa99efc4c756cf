// Triangle with a constant normal (Suffern, chapter 19.3).
//
//   <triangle>
//     <vertexposition1 x="0" y="0" z="0"/> <vertexposition2 x="1" y="0" z="0"/> <vertexposition3 x="0" y="1" z="0"/>
//     <material>red</material>
//   </triangle>
//
// Solved in float as seen from the ray's origin, by the side on which the ray passes each edge (Plücker coordinates;
// Amanatides and Choi, "Ray Tracing Triangular Meshes", 1995): no gaps between triangles that share an edge.
#pragma once

#include <cmath>

#include "raytrace/description/fields.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

class Triangle {
 public:
  struct Parameters {
    Vec3d vertex1{}, vertex2{}, vertex3{};
  };
  static constexpr std::string_view group = "triangles";
  static constexpr std::string_view element = "triangle";
  static Fields<Parameters> fields();
  /// A triangle without area is skipped with a warning.
  static std::optional<Problem> check(const Parameters& parameters);

  template <class T>
  struct Record {
    Vec3<T> vertex1, vertex2, vertex3;
    Vec3<T> normal;  ///< unit length
  };
  static Record<float> record(const Parameters& parameters);
  static Bounds bounds(const Record<float>& triangle);

  /// The distance if it is inside (ray.near, ray.far), in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<float>& triangle, const Ray<F>& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<F>& triangle, const Ray<F>& ray, const F& distance);
};

template <class F>
RAYTRACE_INLINE F Triangle::intersect(const Record<float>& triangle, const Ray<F>& ray, const Mask<F>& active) {
  const Vec3<F> to_vertex1 = Vec3<F>(triangle.vertex1) - ray.origin,
                to_vertex2 = Vec3<F>(triangle.vertex2) - ray.origin,
                to_vertex3 = Vec3<F>(triangle.vertex3) - ray.origin;
  // On which side of an edge the ray passes. An edge the other way round gives the same number with the other sign, bit
  // for bit: no ray slips through between triangles that share it.
  const auto side = [&](const Vec3<F>& from, const Vec3<F>& to) {
    const Vec3<F> e = to - from, to_ends = from + to;
    const auto difference = [](const F& a, const F& b, const F& c, const F& d) { return multiply_add(a, b, -(c * d)); };
    return multiply_add(difference(e.y, to_ends.z, e.z, to_ends.y), ray.direction.x,
                        multiply_add(difference(e.z, to_ends.x, e.x, to_ends.z), ray.direction.y,
                                     difference(e.x, to_ends.y, e.y, to_ends.x) * ray.direction.z));
  };
  const F side12 = side(to_vertex1, to_vertex2), side23 = side(to_vertex2, to_vertex3),
          side31 = side(to_vertex3, to_vertex1);
  const F tolerance = xsimd::abs(side12 + side23 + side31) * F(0x1p-23f);
  const F least = xsimd::min(side12, xsimd::min(side23, side31)), most = xsimd::max(side12, xsimd::max(side23, side31));
  const Mask<F> inside = active & ((least >= -tolerance) | (most <= tolerance));
  if (xsimd::none(inside)) return infinity<F>();
  // A ray in the triangle's plane gives infinity or NaN: no hit.
  const Vec3<F> normal(triangle.normal);
  const F t = dot(normal, to_vertex1) / dot(normal, ray.direction);
  return xsimd::select(inside & (t > ray.near) & (t < ray.far), t, infinity<F>());
}

template <class F>
SurfacePoint<F> Triangle::surface(const Record<F>& triangle, const Ray<F>& ray, const F& distance) {
  const Vec3<F> edge1 = triangle.vertex2 - triangle.vertex1;
  const Vec3<F> edge2 = triangle.vertex3 - triangle.vertex1;
  const Vec3<F> on_ray = ray.at(distance) - triangle.vertex1;
  const Vec3<F> position = triangle.vertex1 + (on_ray - triangle.normal * dot(triangle.normal, on_ray));
  const F size = xsimd::max(xsimd::max(xsimd::max(xsimd::abs(edge1.x), xsimd::abs(edge1.y)), xsimd::abs(edge1.z)),
                            xsimd::max(xsimd::max(xsimd::abs(edge2.x), xsimd::abs(edge2.y)), xsimd::abs(edge2.z)));
  return {position, triangle.normal, rounding_error(position, size)};
}

}  // namespace raytrace
