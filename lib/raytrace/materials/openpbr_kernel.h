// What OpenPBR's parameters say of the lobes of openpbr_bsdf.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "raytrace/materials/medium.h"
#include "raytrace/materials/openpbr.h"
#include "raytrace/materials/openpbr_bsdf.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<OpenPbr> {
 public:
  template <class T>
  using Bsdf = OpenPbrBsdf<T>;

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const OpenPbr::Values<Value>& values) {
    using std::log;
    using std::max;
    using std::min;
    using std::sqrt;
    const auto number = [](const Value& value) { return static_cast<T>(value); };
    const auto each = [](const Rgb<Value>& color, const auto& function) {
      return Rgb<T>(Rgb<Value>(function(color.red), function(color.green), function(color.blue)));
    };
    const auto pick = [](const auto& mask, const Value& a, const Value& b) {
      if constexpr (std::is_same_v<Value, double>)
        return mask ? a : b;
      else
        return select(mask, a, b);
    };
    const auto least = [](const Value& value) { return max(value, Value(1e-30F)); };
    const Value one(1), none(0), half(0.5F);
    Bsdf<T> bsdf;
    // A thin wall sends a part of what it scatters back at once; without walks, all of it is diffuse.
    const Value &below = values.subsurface_weight, &walks = values.walks;
    const Value g = max(min(values.subsurface_scatter_anisotropy, one), none - one);
    const auto has_subsurface = below > none;
    const Value comes_back = pick(values.thin > none, half * (one - g), one - walks),
                goes_on = walks * pick(values.thin > none, half * (one + g), one);
    // One colour of weights that multiply what comes of it, since rough diffuse reflection is not linear in its colour.
    const Value of_base = values.base_weight * (one - below), of_subsurface = below * comes_back,
                diffuse = of_base + of_subsurface;
    const auto base = [&](const Value& color, const Value& inside) {
      return pick(has_subsurface, (of_base * color + of_subsurface * inside) / least(diffuse), color);
    };
    bsdf.base = Rgb<T>(Rgb<Value>(base(values.base_color.red, values.subsurface_color.red),
                                  base(values.base_color.green, values.subsurface_color.green),
                                  base(values.base_color.blue, values.subsurface_color.blue)));
    bsdf.base_weight = number(pick(has_subsurface, diffuse, values.base_weight));
    bsdf.subsurface = number(below * walks);
    bsdf.inside = each(values.subsurface_color, [&](const Value& c) { return c * below * goes_on; });
    bsdf.free_path = each(values.subsurface_radius_scale, [&](const Value& c) { return c * values.subsurface_radius; });
    bsdf.subsurface_anisotropy = number(g);
    bsdf.metal = Rgb<T>(values.base_color * values.base_weight);
    bsdf.specular_color = Rgb<T>(values.specular_color);
    bsdf.diffuse_roughness = number(values.base_diffuse_roughness);
    bsdf.metalness = number(values.base_metalness);
    bsdf.specular_weight = number(values.specular_weight);
    bsdf.transmission = number(values.transmission_weight);
    bsdf.thin = number(values.thin);
    // A depth of 0: the color is the surface's.
    const auto is_deep = values.transmission_depth * values.transmission_weight * (one - values.thin) > none;
    bsdf.tint =
        each(values.transmission_color, [&](const Value& c) { return pick(values.transmission_depth > none, one, c); });
    bsdf.extinction = each(values.transmission_color, [&](const Value& c) {
      return pick(is_deep, -log(least(c)) / least(values.transmission_depth), none);
    });
    // The base below a coat: as rough as light makes it that comes through the coat twice, and of an index over the
    // coat's; that of the denser over the other's, since no light meets it that would be reflected totally.
    const Value &r = values.specular_roughness, &rc = values.coat_roughness, &coat = values.coat_weight;
    const Value rougher = sqrt(sqrt(min(r * r * r * r + Value(2) * rc * rc * rc * rc, one)));
    bsdf.roughness = number(r + (rougher - r) * coat);
    const auto under_coat = [&](const Value& ior) {
      const Value ratio = ior / values.coat_ior, under = pick(ratio < one, one / ratio, ratio);
      return ior + (under - ior) * coat;
    };
    const Value index = under_coat(values.specular_ior);
    const Value root = (index - one) / (index + one);
    const Value size = sqrt(min(values.specular_weight * root * root, Value(0.9F)));
    const Value signed_size = pick(root < none, -size, size);
    bsdf.eta = number((one + signed_size) / (one - signed_size));
    bsdf.film.weight = number(values.thin_film_weight);
    bsdf.film.eta = number(max(under_coat(values.thin_film_ior), one));
    // A tenth of a millimetre has long lost all colours.
    bsdf.film.depth = number(min(Value(2.0F) * values.thin_film_thickness * values.thin_film_ior, Value(100.0F)));
    bsdf.coat = number(coat);
    bsdf.anisotropy = number(values.specular_roughness_anisotropy);
    bsdf.coat_roughness = number(rc);
    bsdf.coat_anisotropy = number(values.coat_roughness_anisotropy);
    bsdf.coat_eta = number(values.coat_ior);
    bsdf.coat_darkening = number(values.coat_darkening);
    bsdf.fuzz = number(values.fuzz_weight);
    bsdf.fuzz_roughness = number(values.fuzz_roughness);
    bsdf.fuzz_color = Rgb<T>(values.fuzz_color);
    // The mean reflectance of the coat from outside: d'Eon, "A Hitchhiker's Guide to Multiple Scattering", 2021.
    const auto mean_reflectance = [&](const Value& eta) {
      return log((Value(10893.0F) * eta - Value(1438.2F)) / (Value(-774.4F) * eta * eta + Value(10212.0F) * eta + one));
    };
    const Value dense = pick(values.coat_ior < one, one / values.coat_ior, values.coat_ior);
    const Value at_most = min(dense, Value(3.0F)), outside = mean_reflectance(at_most);
    const Value inside = one - (one - outside) / (at_most * at_most);
    bsdf.coat_inside = number(max(pick(values.coat_ior < one, outside, inside), none));
    bsdf.coat_extinction = each(values.coat_color, [&](const Value& c) { return Value(-0.5F) * log(least(c)); });
    const auto shining = [&](const Value& c, const Value& coat_color) {
      return values.emission_luminance * c * (one - coat * (one - sqrt(coat_color)));
    };
    bsdf.radiance = Rgb<T>(Rgb<Value>(shining(values.emission_color.red, values.coat_color.red),
                                      shining(values.emission_color.green, values.coat_color.green),
                                      shining(values.emission_color.blue, values.coat_color.blue)));
    return bsdf;
  }
  static Bsdf<float> bsdf(const OpenPbr::Parameters& parameters) {
    return bsdf_of<float, double>(OpenPbr::values(parameters));
  }
  static std::optional<Medium> medium(const OpenPbr::Parameters& parameters, const Bsdf<float>& bsdf) {
    if (!(parameters.transmission_weight > 0) || parameters.geometry_thin_walled) return std::nullopt;
    Medium medium{static_cast<float>(parameters.specular_ior), parameters.priority, bsdf.extinction,
                  static_cast<float>(dispersion_of(OpenPbr::abbe(parameters)))};
    const double depth = parameters.transmission_depth;
    if (!(depth > 0)) return medium;
    const auto scattering = [&](double c) { return std::min(c / depth, 1e30); };
    medium.scattering = Rgb<float>(Rgb<double>(scattering(parameters.transmission_scatter.red),
                                               scattering(parameters.transmission_scatter.green),
                                               scattering(parameters.transmission_scatter.blue)));
    medium.anisotropy = static_cast<float>(std::clamp(parameters.transmission_scatter_anisotropy, -0.98, 0.98));
    // What is absorbed is the rest of the extinction; where more of a colour is scattered than that, grey is added.
    const auto rest = [&](float Rgb<float>::* c) { return medium.extinction.*c - medium.scattering.*c; };
    const float grey = std::max({0.0F, -rest(&Rgb<float>::red), -rest(&Rgb<float>::green), -rest(&Rgb<float>::blue)});
    medium.extinction += Rgb<float>(grey, grey, grey);
    return medium;
  }
};

}  // namespace raytrace
