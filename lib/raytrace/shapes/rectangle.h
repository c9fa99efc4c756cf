// Rectangle: a corner and the two edges that start at it (Suffern, chapter 19.4). The edges need not be at a right
// angle: then it is a parallelogram.
//
//   <rectangle> <corner x="0" y="0" z="0"/> <edge1 x="2" y="0" z="0"/> <edge2 x="0" y="1" z="0"/>
//   <material>red</material>
//   </rectangle>
#pragma once

#include <algorithm>
#include <utility>

#include "raytrace/math/affine.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class Rectangle {
 public:
  struct Parameters {
    Vec3d corner{};
    Vec3d edge1{},
        edge2{};  ///< from the corner to its neighbours; the front is where edge1 turns to edge2 anticlockwise
  };
  static constexpr std::string_view group = "rectangles";
  static constexpr std::string_view element = "rectangle";
  /// A parallelogram stays one; a mirrored one keeps its front.
  static Parameters transformed(const Parameters& parameters, const Affine& affine) {
    Parameters result{affine.point(parameters.corner), affine.vector(parameters.edge1),
                      affine.vector(parameters.edge2)};
    if (affine.determinant() < 0) std::swap(result.edge1, result.edge2);
    return result;
  }
  static bool keeps_uv(const Affine& affine) { return affine.determinant() > 0; }
  static Fields fields() {
    return {required("corner", &Parameters::corner, a_point), required("edge1", &Parameters::edge1, Range::nonzero),
            required("edge2", &Parameters::edge2, Range::nonzero)};
  }
  /// Whether one alone has no inside.
  static bool is_open(const Parameters&) { return true; }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const double area = length(cross(parameters.edge1, parameters.edge2));
    if (area > 1e-12 * length(parameters.edge1) * length(parameters.edge2)) return std::nullopt;
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                               "the rectangle's <edge1> and <edge2> are parallel: it has no area"};
  }

  static double reach(const Parameters& p, const Vec3d& along) {
    return dot(along, p.corner) + std::max(0.0, dot(along, p.edge1)) + std::max(0.0, dot(along, p.edge2));
  }
};

}  // namespace raytrace
