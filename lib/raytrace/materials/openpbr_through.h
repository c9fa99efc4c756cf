// What comes through the facets of OpenPBR's base; a part of openpbr_bsdf.h.
#pragma once

#include "raytrace/materials/openpbr_bsdf.h"

namespace raytrace {

template <class T>
[[gnu::noinline]] BsdfSample<T> OpenPbrBsdf<T>::through_facet(const Lobes& layers, const StretchedGgx<T>& ggx,
                                                              const Passage& way) const {
  const auto& [facet, cosine, fresnel, own_wi, choice] = way;
  const auto& [reflectance, below_cosine] = fresnel;
  const Vec3<T>& from = layers.from;
  const T reflected = select(is_thin(), pane_reflectance(reflectance), reflectance);
  const T eta2 = select(is_thin(), T(1), square(eta)), cosine_i = max(-own_wi.z, T(1e-6F));
  const T lambda_o = ggx.lambda(from), lambda_i = ggx.lambda({own_wi.x, own_wi.y, cosine_i});
  const T across = max(abs(cosine - eta * below_cosine), T(1e-6F));
  const T spread = select(is_thin(), T(0.25F) / cosine, square(eta) * below_cosine / square(across));
  const T facets = ggx.density(facet) * cosine / (from.z * (T(1) + lambda_o));
  const Mask<T> rough = ggx.is_rough();
  Mask<T> comes = (reflected < T(1)) & (-own_wi.z > T(1e-6F));
  const T share = select(is_thin(), layers.white_share, layers.dielectric_share);
  const T density = select(rough, facets * spread, T(1));
  const T shape = select(rough, (T(1) + lambda_o) / ((T(1) + lambda_o + lambda_i) * share), T(1));
  const T part = (T(1) - metalness) * transmission * (T(1) - reflected) * shape * density / (cosine_i * eta2);
  Rgb<T> parts = white() * part;
  if (const Mask<T> filmed = film.weight > T(0); any(filmed)) {
    const Rgb<T> all = select(is_thin() | !rough, white() * share, layers.film_share);
    const T unit = part * share / max(T(1) - reflected, T(1e-6F));
    const auto kept = [&](const T& r) { return (T(1) - select(is_thin(), pane_reflectance(r), r)) * unit; };
    const Rgb<T> r = film.on_dielectric(cosine, eta);
    parts = select(filmed, Rgb<T>{kept(r.red), kept(r.green), kept(r.blue)} / all, parts);
  }
  Vec3<T> wi = own_wi;
  if (layers.frames != nullptr) [[unlikely]] {
    wi = layers.frames->base.from_own(own_wi);
    parts = parts * layers.frames->base.share_from_below(wi, own_wi);
    comes = comes & (wi.z < T(-1e-6F));
  }
  return {wi, select(comes, under_coat(layers, cosine_i) * tint * parts, black()),
          select(comes, choice * density, T(0)), eta2, !rough};
}

template <class T>
BsdfSample<T> OpenPbrBsdf<T>::refracted(const Lobes& layers, const StretchedGgx<T>& ggx, const Vec3<T>& facet,
                                        const T& cosine, const T& choice) const {
  const Vec3<T>& from = layers.from;
  const FresnelReflection<T> fresnel = fresnel_reflection(cosine, eta);
  Vec3<T> flipped = facet * (T(2) * cosine) - from;
  flipped.z = -flipped.z;
  const Vec3<T> bent = facet * (cosine / eta - fresnel.transmitted_cosine) - from * (T(1) / eta);
  return through_facet(layers, ggx, {facet, cosine, fresnel, select(is_thin(), flipped, bent), choice});
}

template <class T>
[[gnu::noinline]] typename OpenPbrBsdf<T>::Value OpenPbrBsdf<T>::through_facets(const Lobes& layers,
                                                                                const Vec3<T>& wi) const {
  const Vec3<T> own = layers.frames == nullptr ? wi : layers.frames->base.to_own(wi);
  // The facet that sends it to wo.
  const Vec3<T> sum = layers.from + select(is_thin(), Vec3<T>{own.x, own.y, -own.z}, own * eta);
  const T size = sqrt(max(dot(sum, sum), T(1e-12F)));
  const Vec3<T> facet = sum * (T(1) / select(sum.z < T(0), -size, size));
  const T dot_facet = dot(layers.from, facet), cosine = min(max(dot_facet, T(1e-6F)), T(1));
  const T choice = layers.facet_choice * (T(1) - reflection_choice(layers, cosine, at_facet(layers, cosine)));
  const Mask<T> is_there = (dot_facet > T(1e-6F)) & (choice > T(0)) & (is_thin() | (dot(own, facet) < T(0)));
  const Passage way{facet, cosine, fresnel_reflection(cosine, eta), own, choice};
  const BsdfSample<T> through = through_facet(layers, ggx(), way);
  return {select(is_there, through.f, black()), select(is_there, through.pdf, T(0))};
}

}  // namespace raytrace
