// Directional light: parallel rays from infinitely far (Suffern, chapter 14).
//
//   <directionallight>
//     <direction x="1" y="1" z="0"/> <scaleradiance>3</scaleradiance> <color red="1" green="1" blue="1"/>
//     <shadows>true</shadows>
//   </directionallight>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class DirectionalLight {
 public:
  struct Parameters {
    Vec3d direction{};  ///< from the scene towards the light; any length but 0
    double scaleradiance = 1;
    Rgb<double> color{1, 1, 1};
    bool shadows = true;
  };
  static constexpr std::string_view group = "directionallights";
  static constexpr std::string_view element = "directionallight";
  static Fields fields() {
    return {required("direction", &Parameters::direction, Range::nonzero),
            optional("scaleradiance", &Parameters::scaleradiance), optional("color", &Parameters::color),
            optional("shadows", &Parameters::shadows)};
  }
};

}  // namespace raytrace
