// Materials of OpenPBR that absorb nothing, and what their BSDFs send on.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bsdfs/judge.h"

namespace raytrace::test {

using PbrBsdf = Kernel<OpenPbr>::Bsdf<FloatN>;

inline PbrBsdf bsdf_of(const OpenPbr::Parameters& parameters, bool front = true) {
  PbrBsdf bsdf = spread_bsdf<Kernel<OpenPbr>::Bsdf>(Kernel<OpenPbr>::bsdf(parameters));
  bsdf.set_side(MaskN(front), FloatN(1));
  return bsdf;
}

inline OpenPbr::Parameters white(double roughness) {
  OpenPbr::Parameters parameters;
  parameters.base_color = {1, 1, 1};
  parameters.specular_roughness = roughness;
  return parameters;
}

/// Materials that absorb nothing, by the layer that each is about.
inline std::vector<std::pair<std::string, OpenPbr::Parameters>> white_materials(double roughness) {
  std::vector<std::pair<std::string, OpenPbr::Parameters>> result;
  const auto add = [&](const std::string& name, const auto& set) {
    OpenPbr::Parameters parameters = white(roughness);
    set(parameters);
    result.emplace_back(name, parameters);
  };
  add("plastic", [](auto&) {});
  add("rough plastic", [&](auto& p) { p.base_diffuse_roughness = roughness; });
  add("metal", [](auto& p) { p.base_metalness = 1; });
  add("half a metal", [](auto& p) { p.base_metalness = 0.5; });
  add("glass", [](auto& p) { p.transmission_weight = 1; });
  add("half glass", [](auto& p) { p.transmission_weight = 0.5; });
  add("pane", [](auto& p) { p.transmission_weight = 1, p.geometry_thin_walled = true; });
  add("half a pane", [](auto& p) { p.transmission_weight = 0.5, p.geometry_thin_walled = true; });
  add("coated plastic", [](auto& p) { p.coat_weight = 1; });
  add("metal with a rough coat", [](auto& p) { p.base_metalness = 1, p.coat_weight = 0.7, p.coat_roughness = 0.5; });
  add("coated glass", [](auto& p) { p.transmission_weight = 1, p.coat_weight = 1, p.coat_roughness = 0.3; });
  add("fuzzy plastic", [&](auto& p) { p.fuzz_weight = 1, p.fuzz_roughness = roughness; });
  add("plastic with a film", [](auto& p) { p.thin_film_weight = 1; });
  add("metal with a film", [](auto& p) { p.base_metalness = p.thin_film_weight = 1; });
  add("glass with a film", [](auto& p) { p.transmission_weight = p.thin_film_weight = 1, p.thin_film_ior = 1.9; });
  add("coated half glass with a film",
      [](auto& p) { p.transmission_weight = 0.5, p.thin_film_weight = 0.7, p.coat_weight = 1, p.thin_film_ior = 2.2; });
  add("wax", [](auto& p) { p.subsurface_weight = 1, p.subsurface_color = {1, 1, 1}; });
  add("coated wax", [](auto& p) {
    p.subsurface_weight = 0.6, p.subsurface_color = {1, 1, 1}, p.coat_weight = 1, p.thin_film_weight = 0.5;
  });
  add("paper", [](auto& p) {
    p.subsurface_weight = 0.7, p.subsurface_color = {1, 1, 1}, p.subsurface_scatter_anisotropy = 0.4;
    p.geometry_thin_walled = true;
  });
  add("bubble", [](auto& p) {
    p.transmission_weight = p.thin_film_weight = 1, p.specular_ior = p.thin_film_ior = 1.33;
    p.thin_film_thickness = 0.3, p.geometry_thin_walled = true;
  });
  add("everything", [&](auto& p) {
    p.transmission_weight = p.base_metalness = p.coat_weight = p.fuzz_weight = 0.5;
    p.coat_roughness = p.base_diffuse_roughness = 0.8;
  });
  return result;
}

/// f |cos| / pdf eta^2.
inline double weight_of(const BsdfSample<FloatN>& sample, std::size_t lane) {
  return double{sample.f.green.get(lane)} * std::abs(double{sample.wi.z.get(lane)}) / double{sample.pdf.get(lane)} *
         double{sample.eta2.get(lane)};
}

/// Its mean: the share of light that is sent on.
template <class Bsdf>
double sent_on(const Bsdf& bsdf, const Vec3d& wo) {
  constexpr int count = 160;
  double sum = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; j += packet_lanes) {
      const FloatN u = batch_of<FloatN>([&](std::size_t lane) {
        const double step = i * 0.75487766624669276 + (j + static_cast<int>(lane)) * 0.56984029099805327;
        return std::min(step - std::floor(step), 1 - 0x1p-24);
      });
      const FloatN u1((static_cast<float>(i) + 0.5F) / count);
      const FloatN u2 = batch_of<FloatN>([&](std::size_t lane) { return (j + static_cast<int>(lane) + 0.5) / count; });
      const BsdfSample<FloatN> sample = bsdf.sample(spread(wo), u, u1, u2);
      for (std::size_t lane = 0; lane < lanes; ++lane)
        if (sample.pdf.get(lane) > 0) sum += weight_of(sample, lane);
    }
  return sum / (double{count} * count);
}

/// What is reflected; other samples go straight down.
template <class Bsdf>
struct Above {
  JudgedBsdf<Bsdf> judged;

  Vec3<FloatN> sample(const Vec3<FloatN>& wo, const Vec3<FloatN>& normal, const FloatN& u1, const FloatN& u2) const {
    const BsdfSample<FloatN> drawn =
        judged.bsdf.sample(wo, batch_of<FloatN>([&](std::size_t) { return judged.lobes.unit(); }), u1, u2);
    return select((drawn.pdf > FloatN(0)) & !drawn.specular & (drawn.wi.z > FloatN(0)), drawn.wi, -normal);
  }
  FloatN pdf(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, const Vec3<FloatN>& normal) const {
    return judged.pdf(wo, wi, normal);
  }
};

}  // namespace raytrace::test
