// Conductor: a metal, smooth or rough.
//
//   <conductor> <name>steel</name> <cr red="0.6" green="0.6" blue="0.6"/> <roughness>0.3</roughness> </conductor>
//   <conductor> <name>ring</name> <metal>gold</metal> </conductor>
//
// It is either of a metal, by its name, or of a colour. The latter reflects the same at every angle, unless it has an
// edge colour: then it grows white towards grazing angles, and edgecolor multiplies it at 82 degrees (OpenPBR's
// F82-tint model; Kutz, Hasan and Edmondson, "Novel Aspects of the Adobe Standard Material", 2021). White is
// Schlick's approximation.
#pragma once

#include "raytrace/materials/metals.h"
#include "raytrace/materials/reflectance.h"
#include "raytrace/materials/surface_detail.h"

namespace raytrace {

class Conductor {
 public:
  /// T: double, or a batch for lanes with textures of their own.
  template <class T>
  struct Values {
    Rgb<T> cr{};                                      ///< reflectance from straight above; black: by the metal
    Rgb<T> edgecolor{};                               ///< black: cr at every angle
    T roughness = T(0);                               ///< in [0, 1], the root of GGX's alpha; 0: smooth
    T anisotropy = T(0);                              ///< in [0, 1]: how long grooves are across u
    T opacity = T(1), normalmap = T(1), bump = T(1);  ///< of surface_detail.h
  };
  struct Parameters : Values<double> {
    Metal metal = Metal::none;
    double tangentrotation = 0, tangentmap = 1;  ///< of surface_detail.h
  };
  static constexpr std::string_view group = "conductors";
  static constexpr std::string_view element = "conductor";
  static Fields fields() {
    return with_tangent<Parameters>(with_surface_detail<Parameters>(
        {optional("cr", &Parameters::cr), optional("edgecolor", &Parameters::edgecolor, Range::not_negative),
         optional("metal", &Parameters::metal), optional("roughness", &Parameters::roughness, Range::not_negative),
         optional("anisotropy", &Parameters::anisotropy, Range::not_negative)}));
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](const char* message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, message};
    };
    const auto is_black = [](const Rgb<double>& c) { return c.red == 0 && c.green == 0 && c.blue == 0; };
    const bool is_named = parameters.metal != Metal::none;
    if (is_named && !is_black(parameters.cr))
      return error("the conductor's <metal> says its colour; remove it or <cr>");
    if (is_named && !is_black(parameters.edgecolor))
      return error("the conductor's <metal> says its colour; remove it or <edgecolor>");
    if (!is_named && is_black(parameters.cr)) return error("the conductor needs a <metal> or a <cr> that is not black");
    if (parameters.roughness > 1) return error("the conductor's <roughness> is above 1");
    if (parameters.anisotropy > 1) return error("the conductor's <anisotropy> is above 1");
    return std::nullopt;
  }
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    std::vector<ParameterWarning> warnings;
    warn_of_gain(warnings, is_textured, "cr", parameters.cr);
    warn_of_gain(warnings, is_textured, "edgecolor", parameters.edgecolor);
    return warnings;
  }
  /// As materials/kernels.h has it.
  static bool focuses(const Parameters&, const auto&) { return true; }
  /// Whether it matters where on the surface u grows.
  static bool is_anisotropic(const Parameters& parameters) { return parameters.anisotropy > 0; }
  /// All that a kernel needs.
  static Values<double> values(const Parameters& parameters) {
    Values<double> result = parameters;
    if (parameters.metal != Metal::none) {
      const MetalColors& colors = metal_colors[static_cast<std::size_t>(parameters.metal)];
      result.cr = colors.normal;
      result.edgecolor = colors.edge;
    }
    return result;
  }
};

}  // namespace raytrace
