// Phong: Matte plus a highlight by a GlossySpecular BRDF (Suffern, chapter 15).
//
//   <phong>
//     <name>plastic</name> <ka>0.25</ka> <kd>0.6</kd> <ks>0.2</ks> <cd red="1" green="0" blue="0"/>
//     <cs red="1" green="1" blue="1"/> <exp>50</exp>
//   </phong>
#pragma once

#include "raytrace/materials/reflectance.h"
#include "raytrace/materials/surface_detail.h"

namespace raytrace {

class Phong {
 public:
  /// T: double, or a batch for lanes with textures of their own.
  template <class T>
  struct Values {
    T ka = T(0);                                      ///< ambient reflection coefficient
    T kd = T(0);                                      ///< diffuse reflection coefficient
    T ks = T(0);                                      ///< specular reflection coefficient
    Rgb<T> cd{};                                      ///< diffuse colour
    Rgb<T> cs{};                                      ///< specular colour
    T exp = T(20);                                    ///< the larger, the smaller the highlight
    T opacity = T(1), normalmap = T(1), bump = T(1);  ///< of surface_detail.h
  };
  using Parameters = Values<double>;
  static constexpr std::string_view group = "phongs";
  static constexpr std::string_view element = "phong";
  static constexpr bool is_even = true;  ///< as Matte's
  static Fields fields() {
    return with_surface_detail<Parameters>(
        {required("ka", &Parameters::ka, Range::not_negative), required("kd", &Parameters::kd, Range::not_negative),
         required("ks", &Parameters::ks, Range::not_negative), required("cd", &Parameters::cd),
         required("cs", &Parameters::cs), optional("exp", &Parameters::exp, Range::not_negative)});
  }
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    std::vector<ParameterWarning> warnings;
    warn_of_gain(warnings, is_textured, "cd", parameters.cd, {"kd", parameters.kd});
    return warnings;
  }
};

}  // namespace raytrace
