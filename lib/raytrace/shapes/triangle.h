// Triangle with a constant normal (Suffern, chapter 19.3).
//
//   <triangle>
//     <vertexposition1 x="0" y="0" z="0"/> <vertexposition2 x="1" y="0" z="0"/> <vertexposition3 x="0" y="1" z="0"/>
//     <material>red</material>
//   </triangle>
#pragma once

#include <algorithm>
#include <utility>

#include "raytrace/math/affine.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class Triangle {
 public:
  struct Parameters {
    Vec3d vertex1{}, vertex2{}, vertex3{};
  };
  static constexpr std::string_view group = "triangles";
  static constexpr std::string_view element = "triangle";
  /// A mirrored one keeps its front.
  static Parameters transformed(const Parameters& parameters, const Affine& affine) {
    Parameters result{affine.point(parameters.vertex1), affine.point(parameters.vertex2),
                      affine.point(parameters.vertex3)};
    if (affine.determinant() < 0) std::swap(result.vertex2, result.vertex3);
    return result;
  }
  static bool keeps_uv(const Affine& affine) { return affine.determinant() > 0; }
  static Fields fields() {
    return {required("vertexposition1", &Parameters::vertex1, a_point),
            required("vertexposition2", &Parameters::vertex2, a_point),
            required("vertexposition3", &Parameters::vertex3, a_point)};
  }
  /// Whether one alone has no inside.
  static bool is_open(const Parameters&) { return true; }

  /// A triangle without area is skipped with a warning.
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    // The tracer keeps vertices as floats, so that is where the area must not vanish.
    const Vec3d a(Vec3f(parameters.vertex1)), b(Vec3f(parameters.vertex2)), c(Vec3f(parameters.vertex3));
    const double area = length(cross(b - a, c - a));
    const double collinear = 1e-12 * length(b - a) * length(c - a);
    if (area > collinear && area > smallest_size * smallest_size) return std::nullopt;
    return ParameterDiagnostic{ParameterDiagnostic::Effect::skip,
                               "the triangle is degenerate (its corners lie on a line) and is left out"};
  }

  static double reach(const Parameters& p, const Vec3d& along) {
    return std::max({dot(along, p.vertex1), dot(along, p.vertex2), dot(along, p.vertex3)});
  }
};

}  // namespace raytrace
