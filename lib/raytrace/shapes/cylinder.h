// Cylinder between two points, open unless it has caps (Suffern, chapter 19.5).
//
//   <cylinder>
//     <bottom x="0" y="0" z="0"/> <top x="0" y="2" z="0"/> <radius>0.5</radius> <material>red</material>
//   </cylinder>
#pragma once

#include <algorithm>

#include "raytrace/parameters/fields.h"
#include "raytrace/shapes/reach.h"

namespace raytrace {

class Cylinder {
 public:
  struct Parameters {
    Vec3d bottom{}, top{};  ///< ends of the axis; they differ
    double radius = 0;
    bool caps = false;  ///< whether disks close it at both ends
  };
  static constexpr std::string_view group = "cylinders";
  static constexpr std::string_view element = "cylinder";
  static Fields fields() {
    return {required("bottom", &Parameters::bottom, a_point), required("top", &Parameters::top, a_point),
            required("radius", &Parameters::radius, Range::positive), optional("caps", &Parameters::caps)};
  }
  /// Whether one alone has no inside.
  static bool is_open(const Parameters& parameters) { return !parameters.caps; }

  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    if (length(parameters.top - parameters.bottom) >= smallest_size) return std::nullopt;
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                               "the cylinder's <bottom> and <top> are the same point: it has no length"};
  }

  static double reach(const Parameters& p, const Vec3d& along) {
    return std::max(dot(along, p.bottom), dot(along, p.top)) + reach_of_disk(p.top - p.bottom, p.radius, along);
  }
};

}  // namespace raytrace
