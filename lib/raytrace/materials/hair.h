// Hair: the fibres of hair and fur, of the objects that are curves.
//
//   <hair>
//     <name>brown</name> <melanin>0.6</melanin> <melaninredness>0.3</melaninredness> <roughness>0.3</roughness>
//     <radialroughness>0.3</radialroughness> <ior>1.55</ior> <scaletilt>2</scaletilt>
//   </hair>
//   <hair> <name>fur</name> <color red="0.7" green="0.5" blue="0.3"/> </hair>
//   <hair> <name>fishing line</name> <absorption red="0.1" green="0.1" blue="0.2"/> </hair>
//
// A clear round fibre, coloured inside, under scales that are tilted towards the root. Light is reflected by its
// surface (R), goes through (TT), comes back after one reflection inside (TRT), or after more. Chiang, Bitterli, Tappan
// and Burley, "A Practical and Controllable Hair and Fur Model for Production Path Tracing", 2016, as chapter 9.9 of
// "Physically Based Rendering" (4th edition) has it.
//
// One of three says what is absorbed inside:
//   color: that of a thick head of such hair, by Chiang's fit, which knows radialroughness;
//   melanin: from 0 to 1, the share that a strand absorbs, so to speak: -ln(1 - melanin) is the concentration, and
//     melaninredness is the share of red pheomelanin in it, the rest is brown eumelanin. These are the numbers of
//     Blender's Principled Hair BSDF, with its coefficients;
//   absorption: for a length of the fibre's radius, so that scale does not matter.
//
// Light that meets a fibre leaves it at the same place, to any side, so that one hit is all that happens in it: rays
// hit it from outside alone.
#pragma once

#include "raytrace/materials/reflectance.h"
#include "raytrace/materials/surface_detail.h"

namespace raytrace {

class Hair {
 public:
  /// T: double, or a batch for lanes with textures of their own.
  template <class T>
  struct Values {
    Rgb<T> color{};            ///< of a thick head of it; black: none
    T melanin = T(0);          ///< in [0, 1]; 0: none
    T melaninredness = T(0);   ///< in [0, 1]: the share of pheomelanin
    Rgb<T> absorption{};       ///< of light, in a length of the fibre's radius; black: none
    T roughness = T(0);        ///< in [0, 1]: how far light is scattered along the fibre
    T radialroughness = T(0);  ///< in [0, 1]: and around it
    T ior = T(1.5);            ///< index of refraction
    T scaletilt = T(2);        ///< in degrees, from the fibre's axis
    T opacity = T(1);          ///< of surface_detail.h
    T by_color = T(0);         ///< 1: the color says what is absorbed; set by values()
  };
  struct Parameters : Values<double> {
    Parameters() { melaninredness = roughness = radialroughness = 0.3, ior = 1.55; }
  };
  static constexpr std::string_view group = "hairs";
  static constexpr std::string_view element = "hair";
  /// Rays hit it from outside alone, and it is of curves alone.
  static constexpr bool is_fibre = true;
  static Fields fields() {
    return with_opacity<Parameters>({optional("color", &Parameters::color, Range::not_negative),
                                     optional("melanin", &Parameters::melanin, Range::not_negative),
                                     optional("melaninredness", &Parameters::melaninredness, Range::not_negative),
                                     optional("absorption", &Parameters::absorption, Range::not_negative),
                                     optional("roughness", &Parameters::roughness, Range::not_negative),
                                     optional("radialroughness", &Parameters::radialroughness, Range::not_negative),
                                     optional("ior", &Parameters::ior, Range::positive),
                                     optional("scaletilt", &Parameters::scaletilt)});
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](const char* message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, message};
    };
    const auto is_given = [](const Rgb<double>& c) { return c.red != 0 || c.green != 0 || c.blue != 0; };
    const int given =
        int{is_given(parameters.color)} + int{parameters.melanin != 0} + int{is_given(parameters.absorption)};
    if (given == 0)
      return error(
          "the hair needs a <melanin> or an <absorption> that is not 0, or a <color> that is not black; white hair, "
          "and a clear fibre, have a white <color>");
    if (given > 1)
      return error("one of <color>, <melanin> and <absorption> says which colour the hair has; remove the others");
    if (parameters.melanin > 1) return error("the hair's <melanin> is above 1");
    if (parameters.melaninredness > 1) return error("the hair's <melaninredness> is above 1");
    if (parameters.roughness > 1) return error("the hair's <roughness> is above 1");
    if (parameters.radialroughness > 1) return error("the hair's <radialroughness> is above 1");
    if (parameters.ior < 1 || parameters.ior > 3) return error("the hair's <ior> is not between 1 and 3");
    if (std::abs(parameters.scaletilt) > most_tilt)
      return error("the hair's <scaletilt> is not between -10 and 10 degrees");
    return std::nullopt;
  }
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    std::vector<ParameterWarning> warnings;
    warn_of_gain(warnings, is_textured, "color", parameters.color);
    return warnings;
  }
  /// As materials/kernels.h has it.
  static bool scatters_through(const Parameters&, const auto&) { return true; }
  /// The tangent is the fibre's axis.
  static bool is_anisotropic(const Parameters&) { return true; }
  /// All that a kernel needs.
  static Values<double> values(const Parameters& parameters) {
    Values<double> result = parameters;
    const Rgb<double>& color = parameters.color;
    result.by_color = color.red != 0 || color.green != 0 || color.blue != 0 ? 1 : 0;
    return result;
  }

  static constexpr double most_tilt = 10;
};

}  // namespace raytrace
