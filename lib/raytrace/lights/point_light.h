// Point light (Suffern, chapter 14).
//
//   <pointlight>
//     <location x="1" y="5" z="0"/> <scaleradiance>3</scaleradiance> <color red="1" green="1" blue="1"/>
//     <shadows>true</shadows> <falloff>none</falloff> <iesfile>lamp.ies</iesfile>
//   </pointlight>
#pragma once

#include "raytrace/lights/falloff.h"
#include "raytrace/parameters/light_group.h"

namespace raytrace {

class PointLight {
 public:
  struct Parameters {
    Vec3d location{};
    double scaleradiance = 1;
    Rgb<double> color{1, 1, 1};
    bool shadows = true;
    Falloff falloff = Falloff::none;
    FileName iesfile{};  ///< of how much goes into each direction (photometry.h); none: the same into all
    Reference group{};   ///< light_group.h
  };
  static constexpr std::string_view group = "pointlights";
  static constexpr std::string_view element = "pointlight";
  static Fields fields() {
    return {required("location", &Parameters::location, a_point),
            optional("scaleradiance", &Parameters::scaleradiance),
            optional("color", &Parameters::color),
            optional("shadows", &Parameters::shadows),
            optional("falloff", &Parameters::falloff),
            optional("iesfile", &Parameters::iesfile),
            light_group<Parameters>()};
  }
};

}  // namespace raytrace
