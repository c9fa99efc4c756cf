// Ambient light: a constant radiance from everywhere, never shadowed (Suffern, chapter 14).
//
//   <ambientlight> <scaleradiance>1</scaleradiance> <color red="1" green="1" blue="1"/> </ambientlight>
#pragma once

#include "raytrace/parameters/light_group.h"

namespace raytrace {

class AmbientLight {
 public:
  struct Parameters {
    double scaleradiance = 1;
    Rgb<double> color{1, 1, 1};
    Reference group{};  ///< light_group.h
  };
  static constexpr std::string_view group = "";  ///< stands in <lights> itself, at most once
  static constexpr std::string_view element = "ambientlight";
  static Fields fields() {
    return {optional("scaleradiance", &Parameters::scaleradiance), optional("color", &Parameters::color),
            light_group<Parameters>()};
  }
};

}  // namespace raytrace
