// Phong: Matte plus a highlight by a GlossySpecular BRDF (Suffern, chapter 15).
//
//   <phong>
//     <name>plastic</name> <ka>0.25</ka> <kd>0.6</kd> <ks>0.2</ks> <cd red="1" green="0" blue="0"/>
//     <cs red="1" green="1" blue="1"/> <exp>50</exp>
//   </phong>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Phong {
 public:
  struct Parameters {
    double ka = 0;     ///< ambient reflection coefficient
    double kd = 0;     ///< diffuse reflection coefficient
    double ks = 0;     ///< specular reflection coefficient
    Rgb<double> cd{};  ///< diffuse colour
    Rgb<double> cs{};  ///< specular colour
    double exp = 20;   ///< the larger, the smaller the highlight
  };
  static constexpr std::string_view group = "phongs";
  static constexpr std::string_view element = "phong";
  static Fields<Parameters> fields() {
    return {required("ka", &Parameters::ka, Range::not_negative),
            required("kd", &Parameters::kd, Range::not_negative),
            required("ks", &Parameters::ks, Range::not_negative),
            required("cd", &Parameters::cd),
            required("cs", &Parameters::cs),
            optional("exp", &Parameters::exp, Range::not_negative)};
  }
};

}  // namespace raytrace
