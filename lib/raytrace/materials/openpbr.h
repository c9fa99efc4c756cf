// OpenPBR: one material for most things, with the parameters of OpenPBR Surface 1.1.1 (Academy Software Foundation) by
// their names there.
//
//   <openpbr>
//     <name>car paint</name> <base_color red="0.6" green="0.02" blue="0.03"/> <base_metalness>0.3</base_metalness>
//     <specular_roughness>0.4</specular_roughness> <coat_weight>1</coat_weight>
//   </openpbr>
//
// From below: a base that is a metal, or a dielectric, which is clear or has a diffuse inside; a thin film on it, whose
// colours are those of waves that interfere; a coat; fuzz. Each layer lets through what it does not reflect.
// geometry_opacity is every material's `opacity`; geometry_normal, geometry_coat_normal and geometry_tangent are those
// of surface_detail.h. Not there: the coat's own tangent.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "raytrace/bsdfs/least_alpha.h"
#include "raytrace/materials/dispersion.h"
#include "raytrace/materials/reflectance.h"
#include "raytrace/materials/surface_detail.h"
#include "raytrace/parameters/light_group.h"

namespace raytrace {

class OpenPbr {
 public:
  /// T: double, or a batch for lanes with textures of their own.
  template <class T>
  struct Values {
    T base_weight = T(1);
    Rgb<T> base_color{T(1), T(1), T(1)};
    T base_diffuse_roughness = T(0), base_metalness = T(0);
    T specular_weight = T(1);
    Rgb<T> specular_color{T(1), T(1), T(1)};
    T specular_roughness = T(0), specular_roughness_anisotropy = T(0), specular_ior = T(1.5);
    T transmission_weight = T(0);
    Rgb<T> transmission_color{T(1), T(1), T(1)};
    T transmission_depth = T(0);
    T subsurface_weight = T(0);
    Rgb<T> subsurface_color{T(1), T(1), T(1)};
    T subsurface_radius = T(1);
    Rgb<T> subsurface_radius_scale{T(1), T(0.5), T(0.25)};
    T subsurface_scatter_anisotropy = T(0);
    T coat_weight = T(0);
    Rgb<T> coat_color{T(1), T(1), T(1)};
    T coat_roughness = T(0), coat_roughness_anisotropy = T(0), coat_ior = T(1.5), coat_darkening = T(1);
    T fuzz_weight = T(0);
    Rgb<T> fuzz_color{T(1), T(1), T(1)};
    T fuzz_roughness = T(0.5);
    T thin_film_weight = T(0), thin_film_thickness = T(0.5), thin_film_ior = T(1.5);
    T emission_luminance = T(0);
    Rgb<T> emission_color{T(1), T(1), T(1)};
    T opacity = T(1), normalmap = T(1), bump = T(1);  ///< of surface_detail.h
    T thin = T(0);                                    ///< 1: thin-walled; set by values()
    T walks = T(1);                                   ///< 1: light goes in below the surface; 0: as if that was diffuse
  };
  struct Parameters : Values<double> {
    Rgb<double> transmission_scatter{0, 0, 0};
    double transmission_scatter_anisotropy = 0;
    double transmission_dispersion_scale = 0, transmission_dispersion_abbe_number = 20;
    bool geometry_thin_walled = false;
    int priority = 0;                                               ///< a dielectric's
    Reference group{};                                              ///< of its emission (light_group.h)
    double tangentrotation = 0, tangentmap = 1, coatnormalmap = 1;  ///< of surface_detail.h

    /// Defaults that no float is.
    Parameters() {
      base_color = {0.8, 0.8, 0.8};
      specular_roughness = 0.3;
      subsurface_color = {0.8, 0.8, 0.8};
      coat_ior = 1.6;
      thin_film_ior = 1.4;
    }
  };
  static constexpr std::string_view group = "openpbrs";
  static constexpr std::string_view element = "openpbr";
  static Fields fields() {
    using P = Parameters;
    const auto number = [](std::string_view name, double P::* member) {
      return optional(name, member, Range::not_negative);
    };
    const auto color = [](std::string_view name, Rgb<double> P::* member) {
      return optional(name, member, Range::not_negative);
    };
    return with_coat_normals<P>(with_tangent<P>(with_surface_detail<P>({
        number("base_weight", &P::base_weight),
        color("base_color", &P::base_color),
        number("base_diffuse_roughness", &P::base_diffuse_roughness),
        number("base_metalness", &P::base_metalness),
        number("specular_weight", &P::specular_weight),
        color("specular_color", &P::specular_color),
        number("specular_roughness", &P::specular_roughness),
        number("specular_roughness_anisotropy", &P::specular_roughness_anisotropy),
        number("specular_ior", &P::specular_ior),
        number("transmission_weight", &P::transmission_weight),
        color("transmission_color", &P::transmission_color),
        number("transmission_depth", &P::transmission_depth),
        constant("transmission_scatter", &P::transmission_scatter, Range::not_negative),
        constant("transmission_scatter_anisotropy", &P::transmission_scatter_anisotropy),
        constant("transmission_dispersion_scale", &P::transmission_dispersion_scale, Range::not_negative),
        constant("transmission_dispersion_abbe_number", &P::transmission_dispersion_abbe_number, Range::not_negative),
        number("subsurface_weight", &P::subsurface_weight),
        color("subsurface_color", &P::subsurface_color),
        number("subsurface_radius", &P::subsurface_radius),
        color("subsurface_radius_scale", &P::subsurface_radius_scale),
        optional("subsurface_scatter_anisotropy", &P::subsurface_scatter_anisotropy),
        number("coat_weight", &P::coat_weight),
        color("coat_color", &P::coat_color),
        number("coat_roughness", &P::coat_roughness),
        number("coat_roughness_anisotropy", &P::coat_roughness_anisotropy),
        number("coat_ior", &P::coat_ior),
        number("coat_darkening", &P::coat_darkening),
        number("fuzz_weight", &P::fuzz_weight),
        color("fuzz_color", &P::fuzz_color),
        number("fuzz_roughness", &P::fuzz_roughness),
        number("thin_film_weight", &P::thin_film_weight),
        number("thin_film_thickness", &P::thin_film_thickness),
        number("thin_film_ior", &P::thin_film_ior),
        number("emission_luminance", &P::emission_luminance),
        color("emission_color", &P::emission_color),
        optional("geometry_thin_walled", &P::geometry_thin_walled),
        optional("priority", &P::priority, Range::not_negative),
        light_group<P>(),
    })));
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](std::string_view name, const char* what) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                                 "the openpbr's <" + std::string(name) + "> is " + what};
    };
    for (const Field& field : fields()) {
      const std::string_view name = field.name;
      if (is_surface_detail(name)) continue;
      if (name.ends_with("_ior")) {
        const double ior = field.get<double>(const_cast<Parameters*>(&parameters));
        if (ior < 0.1 || ior > 10) return error(name, "not between 0.1 and 10");
        if (name == "thin_film_ior" && ior < 1) return error(name, "below 1, which lets no light in at grazing angles");
      } else if (name == "transmission_color" || name == "subsurface_color" || name == "coat_color") {
        const auto& color = field.get<Rgb<double>>(const_cast<Parameters*>(&parameters));
        if (color.red > 1 || color.green > 1 || color.blue > 1) return error(name, "above 1: light would grow inside");
      } else if (name.ends_with("scatter_anisotropy")) {
        if (std::abs(field.get<double>(const_cast<Parameters*>(&parameters))) > 1)
          return error(name, "not between -1 and 1");
      } else if (field.is<double>() && name != "specular_weight" && name != "transmission_depth" &&
                 name != "subsurface_radius" && name != "transmission_dispersion_abbe_number" &&
                 name != "thin_film_thickness" && name != "emission_luminance") {
        if (field.get<double>(const_cast<Parameters*>(&parameters)) > 1) return error(name, "above 1");
      }
    }
    if (parameters.transmission_dispersion_scale > 0) {
      constexpr std::string_view name = "transmission_dispersion_abbe_number";
      const double abbe = parameters.transmission_dispersion_abbe_number;
      if (abbe < least_abbe) return error(name, "below 1");
      if (!has_all_indices(parameters.specular_ior, abbe / parameters.transmission_dispersion_scale))
        return error(name, "so low that nothing is left of its <specular_ior> for blue light");
    }
    return std::nullopt;
  }
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    std::vector<ParameterWarning> warnings;
    // What nothing is seen of does not count.
    const double below = (1 - parameters.transmission_weight) * (1 - parameters.subsurface_weight);
    if (parameters.base_metalness > 0 || below > 0)
      warn_of_gain(warnings, is_textured, "base_color", parameters.base_color, {"base_weight", parameters.base_weight});
    if (parameters.specular_weight > 0)
      warn_of_gain(warnings, is_textured, "specular_color", parameters.specular_color);
    if (parameters.fuzz_weight > 0)
      warn_of_gain(warnings, is_textured, "fuzz_color", parameters.fuzz_color, {"fuzz_weight", parameters.fuzz_weight});
    constexpr double thickest = 20;  // none with colours is thicker
    if (const double thickness = parameters.thin_film_thickness; thickness > thickest)
      warnings.push_back(
          {"thin_film_thickness", "<thin_film_thickness> is in micrometres, of which " + formatted("%.4g", thickness) +
                                      " have no colours; of so many nanometres write <thin_film_thickness>" +
                                      formatted("%.4g", thickness / 1000) + "</thin_film_thickness>"});
    return warnings;
  }
  /// Abbe's number; 0: all wavelengths have the same index.
  static double abbe(const Parameters& parameters) {
    const double scale = parameters.transmission_dispersion_scale;
    return scale > 0 ? parameters.transmission_dispersion_abbe_number / scale : 0;
  }
  /// As materials/kernels.h has it.
  static bool focuses(const Parameters& parameters, const auto& is_textured) {
    const auto constant = [&](std::string_view name) { return !is_textured(name); };
    const bool metal = parameters.base_metalness == 1 && constant("base_metalness");
    const bool glass = parameters.transmission_weight == 1 && constant("transmission_weight") &&
                       parameters.base_metalness == 0 && parameters.specular_roughness == 0 &&
                       parameters.coat_weight == 0;
    return parameters.fuzz_weight == 0 && (metal || glass);
  }
  static bool is_pane(const Parameters& parameters, const auto& is_textured) {
    // A coat makes what is below it rougher.
    const double own = parameters.specular_roughness * parameters.specular_roughness,
                 coat = parameters.coat_weight > 0 ? parameters.coat_roughness * parameters.coat_roughness : 0;
    return parameters.geometry_thin_walled && parameters.transmission_weight > 0 && parameters.base_metalness < 1 &&
           own * own + 2 * coat * coat < double{least_alpha} * least_alpha &&
           parameters.specular_roughness_anisotropy == 0 &&
           (parameters.specular_roughness == 0 || !is_textured("specular_roughness")) &&
           (coat == 0 || !is_textured("coat_roughness"));
  }
  /// As materials/kernels.h has it. Shadow rays know nothing of what textures make of the way inside.
  static bool scatters_through(const Parameters& parameters, const auto& is_textured) {
    const bool clear =
        parameters.transmission_weight > 0 && (parameters.base_metalness < 1 || is_textured("base_metalness"));
    const bool is_textured_inside = !parameters.geometry_thin_walled && parameters.transmission_depth > 0 &&
                                    (is_textured("transmission_color") || is_textured("transmission_depth"));
    return clear && !is_textured_inside && has_facets(parameters);
  }
  /// Whether the base is rough, below its coat; with textures, in some places.
  static bool has_facets(const Parameters& parameters) {
    const double own = parameters.specular_roughness, coat = parameters.coat_roughness;
    const double rougher = std::sqrt(std::sqrt(std::min(own * own * own * own + 2 * coat * coat * coat * coat, 1.0)));
    const double root = own + (rougher - own) * parameters.coat_weight;
    const double across = 1 - parameters.specular_roughness_anisotropy;
    return root * root * std::sqrt(2 / (1 + across * across)) >= double{least_alpha};
  }
  /// Whether light may come through it, bent.
  static bool refracts(const Parameters& parameters) { return parameters.transmission_weight > 0; }
  /// Whether it matters where on the surface u grows.
  static bool is_anisotropic(const Parameters& parameters) {
    return parameters.specular_roughness_anisotropy > 0 || parameters.coat_roughness_anisotropy > 0;
  }
  static constexpr bool has_layers = true;  ///< which have normals of their own where there is relief
  /// Whether it has one anywhere.
  static bool has_coat(const Parameters& parameters) { return parameters.coat_weight > 0; }
  static bool is_two_sided(const Parameters& parameters) { return parameters.geometry_thin_walled; }
  /// All that a kernel needs.
  static Values<double> values(const Parameters& parameters) {
    Values<double> result = parameters;
    result.thin = parameters.geometry_thin_walled ? 1 : 0;
    return result;
  }
};

}  // namespace raytrace
