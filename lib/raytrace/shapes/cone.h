// Cone, perhaps truncated, between two points (Suffern, chapter 19.5).
//
//   <cone>
//     <bottom x="0" y="0" z="0"/> <top x="0" y="2" z="0"/> <radius>0.5</radius> <material>red</material>
//   </cone>
#pragma once

#include <algorithm>

#include "raytrace/parameters/fields.h"
#include "raytrace/shapes/reach.h"

namespace raytrace {

class Cone {
 public:
  struct Parameters {
    Vec3d bottom{}, top{};  ///< ends of the axis; they differ
    double radius = 0;      ///< at the bottom
    double topradius = 0;   ///< at the top; one of the two may be 0: a tip
    bool caps = false;      ///< whether disks close it at both ends
  };
  static constexpr std::string_view group = "cones";
  static constexpr std::string_view element = "cone";
  static Fields fields() {
    return {required("bottom", &Parameters::bottom, a_point), required("top", &Parameters::top, a_point),
            required("radius", &Parameters::radius, Range::not_negative),
            optional("topradius", &Parameters::topradius, Range::not_negative), optional("caps", &Parameters::caps)};
  }
  /// Whether one alone has no inside.
  static bool is_open(const Parameters& parameters) { return !parameters.caps; }

  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    if (length(parameters.top - parameters.bottom) < smallest_size)
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                                 "the cone's <bottom> and <top> are the same point: it has no length"};
    if (parameters.radius < smallest_size && parameters.topradius < smallest_size)
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                                 "the cone's <radius> and <topradius> are both 0: it has no width"};
    return std::nullopt;
  }

  static double reach(const Parameters& p, const Vec3d& along) {
    const Vec3d axis = p.top - p.bottom;
    return std::max(dot(along, p.bottom) + reach_of_disk(axis, p.radius, along),
                    dot(along, p.top) + reach_of_disk(axis, p.topradius, along));
  }
};

}  // namespace raytrace
