// Matte: ambient and diffuse reflection by two Lambertian BRDFs (Suffern, chapter 14).
//
//   <matte> <name>clay</name> <ka>0.25</ka> <kd>0.75</kd> <cd red="1" green="1" blue="0"/> </matte>
#pragma once

#include "raytrace/materials/reflectance.h"
#include "raytrace/materials/surface_detail.h"

namespace raytrace {

class Matte {
 public:
  /// T: double, or a batch for lanes with textures of their own.
  template <class T>
  struct Values {
    T ka = T(0);                                      ///< ambient reflection coefficient
    T kd = T(0);                                      ///< diffuse reflection coefficient
    Rgb<T> cd{};                                      ///< diffuse colour
    T opacity = T(1), normalmap = T(1), bump = T(1);  ///< of surface_detail.h
  };
  using Parameters = Values<double>;
  static constexpr std::string_view group = "mattes";
  static constexpr std::string_view element = "matte";
  static constexpr bool is_even = true;  ///< under relief its light ends softly
  static Fields fields() {
    return with_surface_detail<Parameters>({required("ka", &Parameters::ka, Range::not_negative),
                                            required("kd", &Parameters::kd, Range::not_negative),
                                            required("cd", &Parameters::cd)});
  }
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    std::vector<ParameterWarning> warnings;
    warn_of_gain(warnings, is_textured, "cd", parameters.cd, {"kd", parameters.kd});
    return warnings;
  }
};

}  // namespace raytrace
