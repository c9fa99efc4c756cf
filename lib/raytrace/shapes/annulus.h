// Annulus: a flat disk with a round hole in its middle (Suffern, chapter 19.3).
//
//   <annulus>
//     <center x="0" y="1" z="0"/> <normal x="0" y="1" z="0"/> <innerradius>0.5</innerradius>
//     <outerradius>1</outerradius> <material>red</material>
//   </annulus>
#pragma once

#include "raytrace/parameters/fields.h"
#include "raytrace/shapes/reach.h"

namespace raytrace {

class Annulus {
 public:
  struct Parameters {
    Vec3d center{};
    Vec3d normal{};  ///< of any length but 0; either side is shaded
    double innerradius = 0;
    double outerradius = 0;  ///< the larger one
  };
  static constexpr std::string_view group = "annuli";
  static constexpr std::string_view element = "annulus";
  static Fields fields() {
    return {required("center", &Parameters::center, a_point), required("normal", &Parameters::normal, Range::nonzero),
            required("innerradius", &Parameters::innerradius, Range::not_negative),
            required("outerradius", &Parameters::outerradius, Range::positive)};
  }
  /// Whether one alone has no inside.
  static bool is_open(const Parameters&) { return true; }

  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    if (parameters.innerradius < parameters.outerradius) return std::nullopt;
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                               "the annulus' <innerradius> is not less than its <outerradius>: it has no area"};
  }

  static double reach(const Parameters& p, const Vec3d& along) {
    return dot(along, p.center) + reach_of_disk(p.normal, p.outerradius, along);
  }
};

}  // namespace raytrace
