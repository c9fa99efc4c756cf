// Triangle with a constant normal (Suffern, chapter 19.3).
//
//   <triangle>
//     <vertexposition1 x="0" y="0" z="0"/> <vertexposition2 x="1" y="0" z="0"/> <vertexposition3 x="0" y="1" z="0"/>
//     <material>red</material>
//   </triangle>
//
// The intersection is Embree's own (its robust mode: no gaps between triangles that share an edge).
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

  /// Also the layout of Embree's vertex buffer.
  template <class T>
  struct Record {
    Vec3<T> vertex1, vertex2, vertex3;
  };
  static Record<float> record(const Parameters& parameters);

  /// The surface at the barycentric coordinates that Embree gave: u of vertex 2, v of vertex 3.
  template <class F>
  static SurfacePoint<F> surface(const Record<F>& triangle, const F& u, const F& v);
};

template <class F>
SurfacePoint<F> Triangle::surface(const Record<F>& triangle, const F& u, const F& v) {
  const Vec3<F> edge1 = triangle.vertex2 - triangle.vertex1;
  const Vec3<F> edge2 = triangle.vertex3 - triangle.vertex1;
  const Vec3<F> position = triangle.vertex1 + edge1 * u + edge2 * v;
  const F size = xsimd::max(xsimd::max(xsimd::max(xsimd::abs(edge1.x), xsimd::abs(edge1.y)), xsimd::abs(edge1.z)),
                            xsimd::max(xsimd::max(xsimd::abs(edge2.x), xsimd::abs(edge2.y)), xsimd::abs(edge2.z)));
  // Embree's distance is off in proportion to the triangle's length over its altitude, as far as that exceeds 1.
  const Vec3<F> perpendicular = cross(edge1, edge2);
  const F inverse_area = F(1) / length(perpendicular);
  const F sliver = xsimd::max(F(1), xsimd::max(dot(edge1, edge1), dot(edge2, edge2)) * inverse_area);
  return {position, perpendicular * inverse_area, rounding_error(position, size) * sliver};
}

}  // namespace raytrace
