// Directional light: parallel rays from infinitely far (Suffern, chapter 14), or those of a disk there, as a sun is
// one.
//
//   <directionallight>
//     <direction x="1" y="1" z="0"/> <scaleradiance>3</scaleradiance> <color red="1" green="1" blue="1"/>
//     <shadows>true</shadows> <angle>0.53</angle>
//   </directionallight>
#pragma once

#include "raytrace/parameters/light_group.h"

namespace raytrace {

class DirectionalLight {
 public:
  struct Parameters {
    Vec3d direction{};  ///< from the scene towards the light; any length but 0
    double scaleradiance = 1;
    Rgb<double> color{1, 1, 1};
    bool shadows = true;
    double angle = 0;   ///< of the disk's diameter, in degrees, at most 180; its radiance is spread over it
    Reference group{};  ///< light_group.h
  };
  static constexpr std::string_view group = "directionallights";
  static constexpr std::string_view element = "directionallight";
  static Fields fields() {
    return {required("direction", &Parameters::direction, Range::nonzero),
            optional("scaleradiance", &Parameters::scaleradiance),
            optional("color", &Parameters::color),
            optional("shadows", &Parameters::shadows),
            optional("angle", &Parameters::angle, Range::not_negative),
            light_group<Parameters>()};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    if (parameters.angle <= 180) return std::nullopt;
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                               "the directional light's <angle> is above 180 degrees; a sun's is 0.53"};
  }
};

}  // namespace raytrace
