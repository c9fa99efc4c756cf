// Spotlight: a point light that shines into a cone.
//
//   <spotlight>
//     <location x="0" y="5" z="0"/> <lookat x="0" y="0" z="0"/> <coneangle>40</coneangle>
//     <penumbraangle>5</penumbraangle> <scaleradiance>3</scaleradiance> <color red="1" green="1" blue="1"/>
//     <shadows>true</shadows> <falloff>none</falloff> <iesfile>lamp.ies</iesfile>
//   </spotlight>
#pragma once

#include "raytrace/lights/falloff.h"
#include "raytrace/parameters/light_group.h"

namespace raytrace {

class SpotLight {
 public:
  struct Parameters {
    Vec3d location{}, lookat{};  ///< they differ
    double coneangle = 0;        ///< of the whole cone, in degrees, at most 360
    double penumbraangle = 0;    ///< inside the cone's edge, in degrees: where the light grows from nothing to all
    double scaleradiance = 1;
    Rgb<double> color{1, 1, 1};
    bool shadows = true;
    Falloff falloff = Falloff::none;
    FileName iesfile{};  ///< as of a point light; its axis is that of the cone
    Reference group{};   ///< light_group.h
  };
  static constexpr std::string_view group = "spotlights";
  static constexpr std::string_view element = "spotlight";
  static Fields fields() {
    return {required("location", &Parameters::location, a_point),
            required("lookat", &Parameters::lookat, a_point),
            required("coneangle", &Parameters::coneangle, Range::positive),
            optional("penumbraangle", &Parameters::penumbraangle, Range::not_negative),
            optional("scaleradiance", &Parameters::scaleradiance),
            optional("color", &Parameters::color),
            optional("shadows", &Parameters::shadows),
            optional("falloff", &Parameters::falloff),
            optional("iesfile", &Parameters::iesfile),
            light_group<Parameters>()};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](const char* message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, message};
    };
    if (length(parameters.location - parameters.lookat) < smallest_size)
      return error("the spotlight's <location> and <lookat> are the same point: it shines nowhere");
    if (parameters.coneangle > 360) return error("the spotlight's <coneangle> is above 360 degrees");
    if (parameters.penumbraangle > parameters.coneangle / 2)
      return error("the spotlight's <penumbraangle> is above half its <coneangle>: the cone has no room for it");
    return std::nullopt;
  }
};

}  // namespace raytrace
