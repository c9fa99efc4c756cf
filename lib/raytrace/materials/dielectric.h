// Dielectric: what is clear, such as glass and water. It reflects and refracts as Fresnel's equations say.
//
//   <dielectric>
//     <name>green glass</name> <ior>1.52</ior> <roughness>0.1</roughness> <cr red="1" green="1" blue="1"/>
//     <ct red="1" green="1" blue="1"/> <attenuationcolor red="0.4" green="0.9" blue="0.5"/>
//     <attenuationdistance>2</attenuationdistance> <abbe>60</abbe> <thinwalled>false</thinwalled>
//     <priority>0</priority>
//   </dielectric>
//
// What is behind its front is inside: the front of a closed shape is its outside, that of a triangle the side from
// which its vertices run counter-clockwise. Light that is inside is attenuated. Where dielectrics are in each other,
// the one of the highest priority counts (scene/medium_table.h). A thin wall has nothing inside: it is a pane of two
// parallel faces with no distance between them, between which light goes to and fro, and what comes through is not
// bent. A rough one scatters what comes through as it does what it reflects, but to the other side (Burley, "Extending
// the Disney BRDF to a BSDF", SIGGRAPH course 2015). With an Abbe number, light of each wavelength is bent by an index
// of its own (materials/dispersion.h). Shadow rays do not come through all of it: where light leaves a rough one, it is
// drawn as where it is reflected; lights behind smooth ones are seen by paths alone that meet them.
#pragma once

#include "raytrace/materials/dispersion.h"
#include "raytrace/materials/reflectance.h"
#include "raytrace/materials/surface_detail.h"

namespace raytrace {

class Dielectric {
 public:
  /// T: double, or a batch for lanes with textures of their own.
  template <class T>
  struct Values {
    T ior = T(1.5);                                   ///< index of refraction inside, over that outside
    T roughness = T(0);                               ///< in [0, 1], the root of GGX's alpha; 0: smooth
    Rgb<T> cr{T(1), T(1), T(1)};                      ///< multiplies what is reflected
    Rgb<T> ct{T(1), T(1), T(1)};                      ///< multiplies what comes through
    Rgb<T> attenuationcolor{T(1), T(1), T(1)};        ///< what white light becomes inside after
    T attenuationdistance = T(0);                     ///< so far; 0: it stays as it is
    T opacity = T(1), normalmap = T(1), bump = T(1);  ///< of surface_detail.h
    T thin = T(0);                                    ///< 1: thin-walled; set by values()
  };
  struct Parameters : Values<double> {
    bool thinwalled = false;
    double abbe = 0;   ///< Abbe's number; 0: one index for all wavelengths
    int priority = 0;  ///< where it is in others: the highest counts, of equal ones what light came into last
  };
  static constexpr std::string_view group = "dielectrics";
  static constexpr std::string_view element = "dielectric";
  static Fields fields() {
    return with_surface_detail<Parameters>(
        {optional("ior", &Parameters::ior, Range::positive),
         optional("roughness", &Parameters::roughness, Range::not_negative), optional("cr", &Parameters::cr),
         optional("ct", &Parameters::ct),
         optional("attenuationcolor", &Parameters::attenuationcolor, Range::not_negative),
         optional("attenuationdistance", &Parameters::attenuationdistance, Range::not_negative),
         constant("abbe", &Parameters::abbe, Range::not_negative), optional("thinwalled", &Parameters::thinwalled),
         optional("priority", &Parameters::priority, Range::not_negative)});
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](const char* message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, message};
    };
    const Rgb<double>& color = parameters.attenuationcolor;
    const bool attenuates = color.red != 1 || color.green != 1 || color.blue != 1;
    if (parameters.ior < 0.1 || parameters.ior > 10) return error("the dielectric's <ior> is not between 0.1 and 10");
    if (parameters.roughness > 1) return error("the dielectric's <roughness> is above 1");
    if (color.red > 1 || color.green > 1 || color.blue > 1)
      return error("the dielectric's <attenuationcolor> is above 1: light would grow inside");
    if (attenuates && parameters.attenuationdistance == 0)
      return error("the dielectric's <attenuationcolor> needs an <attenuationdistance> after which light has it");
    if (parameters.thinwalled && parameters.attenuationdistance > 0)
      return error("the dielectric is thin-walled: nothing inside has an <attenuationdistance>");
    if (parameters.abbe == 0) return std::nullopt;
    if (parameters.thinwalled) return error("the dielectric is thin-walled: it bends no light, so <abbe> says nothing");
    if (parameters.abbe < least_abbe)
      return error("the dielectric's <abbe> is below 1; without one, or with 0, its <ior> is that of all wavelengths");
    if (!has_all_indices(parameters.ior, parameters.abbe))
      return error("the dielectric's <abbe> is so low that nothing is left of its <ior> for blue light");
    return std::nullopt;
  }
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    std::vector<ParameterWarning> warnings;
    warn_of_gain(warnings, is_textured, "cr", parameters.cr);
    warn_of_gain(warnings, is_textured, "ct", parameters.ct);
    return warnings;
  }
  /// As materials/kernels.h has it.
  static bool focuses(const Parameters& parameters, const auto&) {
    return parameters.roughness * parameters.roughness < 1e-3;  // Ggx's least alpha
  }
  static bool refracts(const Parameters&) { return true; }
  /// As materials/kernels.h has it. Shadow rays know nothing of what textures make of the way inside.
  static bool scatters_through(const Parameters& parameters, const auto& is_textured) {
    return !focuses(parameters, is_textured) && !is_textured("attenuationcolor") && !is_textured("attenuationdistance");
  }
  static bool is_pane(const Parameters& parameters, const auto& is_textured) {
    return parameters.thinwalled && focuses(parameters, is_textured) &&
           (parameters.roughness == 0 || !is_textured("roughness"));
  }
  /// All that a kernel needs.
  static Values<double> values(const Parameters& parameters) {
    Values<double> result = parameters;
    result.thin = parameters.thinwalled ? 1 : 0;
    return result;
  }
};

}  // namespace raytrace
