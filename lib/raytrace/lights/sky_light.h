// Daylight: a clear or hazy sky with its sun.
//
//   <skylight>
//     <sundirection x="1" y="1" z="0.5"/> <turbidity>3</turbidity> <groundalbedo red="0.2" green="0.2" blue="0.2"/>
//     <scaleradiance>1</scaleradiance> <visible>true</visible>
//     <group>sky</group> <sungroup>sun</sungroup>
//   </skylight>
//
// lights/atmosphere.h says whose model it is.
#pragma once

#include "raytrace/parameters/light_group.h"

namespace raytrace {

class SkyLight {
 public:
  struct Parameters {
    Vec3d sundirection{};                     ///< towards the sun; above the horizon. Up is +y
    double turbidity = 3;                     ///< haze: 1 is pure air, 2 a very clear day, 10 a hazy one
    Rgb<double> groundalbedo{0.2, 0.2, 0.2};  ///< of the ground, which is what is below the horizon
    double scaleradiance = 1;
    bool visible = true;   ///< to the camera, in place of the background
    Reference group{};     ///< light_group.h
    Reference sungroup{};  ///< of the sun, where it is another one

    const Reference& group_of_sun() const { return sungroup.name.empty() ? group : sungroup; }
  };
  static constexpr std::string_view group = "skylights";  ///< a scene has one item at most, and no environment light
  static constexpr std::string_view element = "skylight";
  static Fields fields() {
    return {required("sundirection", &Parameters::sundirection, Range::nonzero),
            optional("turbidity", &Parameters::turbidity, Range::not_negative),
            optional("groundalbedo", &Parameters::groundalbedo, Range::not_negative),
            optional("scaleradiance", &Parameters::scaleradiance, Range::not_negative),
            optional("visible", &Parameters::visible),
            light_group<Parameters>(),
            light_group("sungroup", &Parameters::sungroup)};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](const char* message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, message};
    };
    if (!(parameters.sundirection.y > 0))
      return error("the skylight's <sundirection> is not above the horizon (y is up): there is no model of the night");
    if (parameters.turbidity < 1 || parameters.turbidity > 10)
      return error("the skylight's <turbidity> is not from 1, pure air, to 10, a hazy one");
    return std::nullopt;
  }
};

}  // namespace raytrace
