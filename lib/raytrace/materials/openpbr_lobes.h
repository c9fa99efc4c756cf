// What the lobes of OpenPBR have in common for one wo; a part of openpbr_bsdf.h.
#pragma once

#include "raytrace/materials/openpbr_bsdf.h"

namespace raytrace {

template <class T>
[[gnu::noinline]] typename OpenPbrBsdf<T>::Lobes OpenPbrBsdf<T>::lobes(const Vec3<T>& wo,
                                                                       const LayerFrames<T>* frames) const {
  Lobes layers{};
  layers.frames = frames;
  layers.from = frames != nullptr ? frames->base.own_wo() : above_surface(wo, local_normal<T>());
  const T cosine = min(layers.from.z, T(1)), one(1);
  const Mask<T> rough = ggx().is_rough();
  layers.base_reflection = fresnel_reflection(cosine, eta).reflectance;
  layers.dielectric_share = layers.white_share = one;
  if (any(rough)) {
    const T even = ggx().even_roughness();
    layers.white_share = select(rough, ggx_reflected_share(cosine, even), one);
    const Mask<T> stretched = rough & (ggx().alpha_y < ggx().alpha_x);
    if (any(stretched))
      layers.white_share = select(stretched, stretched_reflected_share(ggx(), layers.from), layers.white_share);
    layers.dielectric_share = select(rough, ggx_dielectric_share(cosine, even, eta), one);
    layers.base_reflection =
        select(rough, ggx_dielectric_share<true>(cosine, even, eta) / layers.dielectric_share, layers.base_reflection);
    if (const Mask<T> total = rough & reflects_totally(); any(total)) {
      const T reflected = reflection_about_total(ggx(), layers.from, eta);
      layers.base_reflection = select(total, reflected / layers.dielectric_share, layers.base_reflection);
    }
  }
  if (any(film.weight > T(0))) set_film(layers, cosine);
  layers.under_fuzz = one;
  if (any(fuzz > T(0))) {
    layers.fibers = Fuzz<T>(layers.from, fuzz_roughness);
    layers.under_fuzz = one - fuzz * layers.fibers.albedo;
  }
  layers.coat_albedo = T(0);
  layers.coat_share = one;
  layers.darkening = white();
  if (any(coat > T(0))) {
    const Mask<T> rough_coat = coat_ggx().is_rough();
    const T coat_cosine = min(coat_from(layers).z, T(1));
    const T smooth = fresnel_reflection(coat_cosine, coat_eta).reflectance;
    layers.coat_albedo = smooth;
    if (any(rough_coat)) {
      const T even = coat_ggx().even_roughness();
      layers.coat_share = select(rough_coat, ggx_dielectric_share(coat_cosine, even, coat_eta), one);
      const T reflected = ggx_dielectric_share<true>(coat_cosine, even, coat_eta) / layers.coat_share;
      layers.coat_albedo = select(rough_coat, reflected, smooth);
      if (const Mask<T> total = rough_coat & (coat_eta < T(1)); any(total)) {
        const T of_total = reflection_about_total(coat_ggx(), coat_from(layers), coat_eta) / layers.coat_share;
        layers.coat_albedo = select(total, of_total, layers.coat_albedo);
      }
    }
    layers.coat_albedo = layers.coat_albedo * coat;
    // What comes from below is reflected by the coat's inside again and again.
    const T straight = normal_reflectance(eta);
    const Rgb<T> below = mix(mix(mix(base * base_weight + inside, tint, transmission), white(), straight),
                             metal * specular_weight, metalness);
    const T spread = mix(mix(one, roughness, straight), roughness, metalness);
    const T again = mix(smooth, coat_inside, spread);
    const auto darkened = [&](const T& b) {
      return one - coat * coat_darkening * (one - (one - again) / max(one - b * again, T(1e-3F)));
    };
    layers.darkening = {darkened(below.red), darkened(below.green), darkened(below.blue)};
  }
  // As much as comes of each.
  const Rgb<T> under = under_coat(layers, coat_from(layers).z);
  const T of_base = mean(under) * (one - layers.base_reflection) * (one - metalness);
  T specular = mean(under * at_facet_of(layers, cosine, layers.base_reflection));
  if (const Mask<T> filmed = film.weight > T(0); any(filmed))
    specular =
        select(filmed, mean(under * at_film_of(layers, layers.film_reflection, metal_with_film(cosine))), specular);
  const T coated = layers.coat_albedo * layers.under_fuzz, fibers = (one - layers.under_fuzz) * mean(fuzz_color);
  const T through = of_base * transmission * mean(tint);
  const T diffuse = of_base * (one - transmission) * base_weight * mean(base);
  const T enters = of_base * (one - transmission) * mean(inside);
  const T all = fibers + coated + specular + through + diffuse + enters;
  const Mask<T> some = all > T(0);
  const T scale = one / select(some, all, one);
  layers.fuzz_choice = fibers * scale;
  layers.coat_choice = coated * scale;
  layers.facet_choice = (specular + through) * scale;
  layers.inside_choice = enters * scale;
  return layers;
}

template <class T>
[[gnu::noinline]] T OpenPbrBsdf<T>::reflection_about_total(const StretchedGgx<T>& facets, const Vec3<T>& from,
                                                           const T& index) {
  const T cosine = min(from.z, T(1)), even = facets.even_roughness();
  const T reflected = total_reflection(cosine, even, index) * ggx_reflected_share(cosine, even);
  const Mask<T> stretched = facets.alpha_y < facets.alpha_x;
  if (none(stretched)) return reflected;
  return select(stretched, stretched_dielectric_reflection(facets, from, index), reflected);
}

template <class T>
[[gnu::noinline]] void OpenPbrBsdf<T>::set_film(Lobes& layers, const T& cosine) const {
  const Mask<T> rough = ggx().is_rough();
  const auto reflectance = [&](const T& at_facet) { return film.on_dielectric(at_facet, eta); };
  layers.film_share = white();
  layers.film_reflection = reflectance(cosine);
  if (any(rough)) {
    const T even = ggx().even_roughness();
    GgxShares changes = ggx_share_changes(cosine, even, eta, reflectance);
    if (const Mask<T> total = rough & reflects_totally(); any(total)) {
      const auto better = ggx_share_changes<FacetLattice>(cosine, even, eta, reflectance);
      changes = {select(total, better.all, changes.all), select(total, better.reflected, changes.reflected)};
    }
    const Rgb<T> all = white() * layers.dielectric_share + changes.all;
    const Rgb<T> reflected = white() * (layers.dielectric_share * layers.base_reflection) + changes.reflected;
    layers.film_share = select(rough, all, white());
    layers.film_reflection = select(rough, reflected / all, layers.film_reflection);
  }
  layers.under_film = white() + layers.film_reflection * T(-1);
  layers.base_reflection = select(film.weight > T(0), mean(layers.film_reflection), layers.base_reflection);
}

template <class T>
[[gnu::noinline]] Rgb<T> OpenPbrBsdf<T>::gloss(const Lobes& layers, const Vec3<T>& wi, Gloss which) const {
  const T roughest(which == Gloss::sharp ? glossy_roughness : 2.0F);
  const LayerFrames<T>* const frames = layers.frames;
  const Vec3<T> base_wi = frames == nullptr ? wi : frames->base.to_own(wi),
                coat_wi = frames == nullptr ? wi : frames->coat.to_own(wi);
  Value result{black(), T(0)};
  if (const Mask<T> near = ggx().is_rough() & (roughness < roughest); any(near))
    result.f = select(near, by_facets(layers, base_wi).f * under_coat(layers, coat_wi.z), black());
  if (frames != nullptr) frames->base.count_about_surface(wi, base_wi, result.f, result.pdf);
  if (const Mask<T> near = coat_ggx().is_rough() & (coat > T(0)) & (coat_roughness < roughest); any(near))
    result.f += select(near, by_coat(layers, wi, coat_wi).f, black());
  return select(wi.z > T(1e-6F), result.f, black());
}

}  // namespace raytrace
