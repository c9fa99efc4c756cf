// How OpenPBR's surfaces scatter light: lobes over each other, of which each lets through what it does not reflect of
// light from wo's side (OpenPBR 1.1.1, "Reduction to a mixture of lobes"). Their f is not reciprocal.
//
// Where the coat and the base have normals of their own, each is in a frame of its own (bsdfs/layer_normals.h), and
// fuzz in that of the base. The coat lets through what its Fresnel reflection leaves of light that leaves towards wo
// about the coat's normal, wherever light comes from.
//
// On the inside of what light comes through, the dielectric's boundary alone counts. Emission is the same in all
// directions: the coat takes from it what it takes of light that leaves straight away.
#pragma once

#include <cmath>
#include <type_traits>

#include "raytrace/bsdfs/fuzz.h"
#include "raytrace/bsdfs/ggx_shares.h"
#include "raytrace/bsdfs/lambertian.h"
#include "raytrace/bsdfs/layer_normals.h"
#include "raytrace/bsdfs/oren_nayar.h"
#include "raytrace/bsdfs/stretched_shares.h"
#include "raytrace/bsdfs/thin_film.h"
#include "raytrace/bsdfs/total_reflection.h"
#include "raytrace/materials/medium.h"
#include "raytrace/materials/subsurface.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/rgba.h"

namespace raytrace {

/// T: a batch, or what records hold.
template <class T>
struct OpenPbrBsdf {
  Rgb<T> base, metal, specular_color, tint;  ///< tint: of what comes through
  T base_weight, diffuse_roughness, metalness, specular_weight, roughness, anisotropy;
  T eta;  ///< of the base, over what is on wo's side
  T transmission, thin;
  T subsurface;      ///< the share of the diffuse light that goes in below the surface
  Rgb<T> inside;     ///< what of light that spreads evenly comes out again elsewhere, with that share
  Rgb<T> free_path;  ///< the mean free path inside
  T subsurface_anisotropy;
  Rgb<T> extinction;  ///< inside, for a unit of length
  T coat, coat_roughness, coat_anisotropy, coat_eta, coat_darkening;
  T coat_inside;           ///< the share of evenly spread light from below that the coat reflects
  Rgb<T> coat_extinction;  ///< for the coat's thickness
  T fuzz, fuzz_roughness;
  Rgb<T> fuzz_color;
  ThinFilm<T> film;
  Rgb<T> radiance;

  /// evaluate() is in the local frame, as all others are.
  static constexpr bool in_local_frame = true;

  template <class Front>
  void set_side(const Front& front, const Refraction<T>& media) {
    const T& outside = media.outside;
    eta = media.inside(eta);
    // Below a coat, eta is over the coat's; what light does not come into is as in air.
    const auto clear = transmission > T(0), within = clear & !(front | is_thin());
    film.eta = select(clear & !within, film.eta / outside, film.eta);
    eta = select(within, outside / eta, select(clear & !(coat > T(0)), eta / outside, eta));
    transmission = select(within, T(1), transmission);
    metalness = select(within, T(0), metalness);
    coat = select(within, T(0), coat);
    fuzz = select(within, T(0), fuzz);
    specular_color = select(within, white(), specular_color);
    film.eta = select(within, film.eta * eta, film.eta);
    // Walks go in below the front alone: from behind there is no inside to walk in.
    if (const auto walks = subsurface > T(0); any(walks)) {
      const auto behind = walks & !(front | is_thin());
      const T weight = base_weight + subsurface;
      base = select(behind, (base * base_weight + inside) * (T(1) / weight), base);
      base_weight = select(behind, weight, base_weight);
      inside = select(behind, black(), inside);
    }
  }

  Rgb<T> emitted() const { return radiance; }
  Rgb<T> ambient_radiance(const Rgb<T>&) const { return black(); }
  Rgb<T> albedo() const {
    return mix(mix(base * base_weight + inside, tint, transmission), metal * specular_weight, metalness);
  }
  /// As of a conductor.
  Rgb<T> usual_f() const { return albedo(); }
  /// Of one whose facets are smooth and thin.
  Rgb<T> straight(const Vec3<T>& wo) const {
    const Lobes layers = lobes(wo);
    const BsdfSample<T> through = refracted(layers, ggx(), local_normal<T>(), min(layers.from.z, T(1)), T(1));
    return through.f * -through.wi.z;
  }
  Rgb<T> transmittance(const T& distance) const { return exp_of(extinction, -distance); }
  Subsurface<T> subsurface_inside() const {
    return Subsurface<T>::of(inside * (T(1) / max(subsurface, T(1e-6F))), free_path, subsurface_anisotropy, is_thin());
  }

  /// What evaluate(), pdf() and sample() have in common for one wo.
  struct Lobes {
    const LayerFrames<T>* frames;  ///< null where no layer has normals of its own
    Vec3<T> from;                  ///< wo to the base
    Fuzz<T> fibers;
    T under_fuzz;                                             ///< what fuzz leaves of all below it
    T coat_albedo, coat_share;                                ///< what the coat reflects; what its facets send on
    Rgb<T> darkening;                                         ///< of what is below the coat
    T base_reflection;                                        ///< what the boundary of the dielectric reflects
    T dielectric_share, white_share;                          ///< what the base's facets send on
    Rgb<T> film_share, film_reflection, under_film;           ///< of a dielectric with a film; what comes through
    T fuzz_choice, coat_choice, facet_choice, inside_choice;  ///< how often sample() takes them; the rest is diffuse
  };
  /// frames: of wo.
  Lobes lobes(const Vec3<T>& wo, const LayerFrames<T>* frames = nullptr) const;

  struct Value {
    Rgb<T> f;
    T pdf;  ///< at which sample() draws wi
  };
  /// Of what is not smooth: what it reflects for wi above the surface, what comes through the base for wi below it.
  Value value(const Lobes& layers, const Vec3<T>& wi) const {
    Value result = reflected(layers, wi);
    const Mask<T> below = wi.z < T(-1e-6F);
    if (none(below)) [[likely]]
      return result;
    if (const Mask<T> through = below & lets_through() & ggx().is_rough(); any(through)) {
      const Value from_behind = through_facets(layers, wi);
      result.f = select(through, from_behind.f, result.f);
      result.pdf = select(through, from_behind.pdf, result.pdf);
    }
    return result;
  }
  /// The first alone: else it is 0.
  Value reflected(const Lobes& layers, const Vec3<T>& wi) const {
    const LayerFrames<T>* const frames = layers.frames;
    if (frames == nullptr) return reflected(layers, wi, wi, wi, wi);
    return reflected(layers, wi, frames->diffuse.to_own(wi), frames->base.to_own(wi), frames->coat.to_own(wi));
  }
  /// diffuse_wi, base_wi, coat_wi: wi to them.
  [[gnu::noinline]] Value reflected(const Lobes& layers, const Vec3<T>& wi, const Vec3<T>& diffuse_wi,
                                    const Vec3<T>& base_wi, const Vec3<T>& coat_wi) const {
    const LayerFrames<T>* const frames = layers.frames;
    const Mask<T> is_above = wi.z > T(1e-6F);
    const T even = T(1) - layers.fuzz_choice - layers.coat_choice - layers.facet_choice - layers.inside_choice;
    const T diffuse = (T(1) - metalness) * (T(1) - transmission) * (T(1) - layers.base_reflection) * base_weight;
    const Vec3<T>& diffuse_from = frames != nullptr ? frames->diffuse.own_wo() : layers.from;
    const Rgb<T> even_f = OrenNayar<T>{base, diffuse_roughness}.f(diffuse_from, diffuse_wi);
    Value result{even_f * diffuse, max(even, T(0)) * diffuse_wi.z * T(std::numbers::inv_pi_v<float>)};
    if (const Mask<T> filmed = film.weight > T(0); any(filmed)) {
      const T share = (T(1) - metalness) * (T(1) - transmission) * base_weight;
      result.f = select(filmed, even_f * share * layers.under_film, result.f);
    }
    if (frames != nullptr) {
      result.f = result.f * frames->diffuse.softness(wi, diffuse_wi);
      frames->diffuse.count_about_surface(wi, diffuse_wi, result.f, result.pdf);
    }
    if (const Mask<T> rough = ggx().is_rough(); any(rough)) {
      Value facets = by_facets(layers, base_wi);
      if (frames != nullptr) frames->base.count_about_surface(wi, base_wi, facets.f, facets.pdf);
      result.f += select(rough, facets.f, black());
      result.pdf = result.pdf + select(rough, facets.pdf, T(0));
    }
    result.f = result.f * under_coat(layers, coat_wi.z);
    if (const Mask<T> rough = coat_ggx().is_rough() & (coat > T(0)); any(rough)) {
      const Value facets = by_coat(layers, wi, coat_wi);
      result.f += select(rough, facets.f, black());
      result.pdf = result.pdf + select(rough, facets.pdf, T(0));
    }
    if (const Mask<T> fuzzy = fuzz > T(0); any(fuzzy)) {
      T f = layers.fibers.density(base_wi), pdf = f;
      if (frames != nullptr) frames->base.count_about_surface(wi, base_wi, f, pdf);
      result.f += select(fuzzy, fuzz_color * (fuzz * layers.fibers.albedo * f), black());
      result.pdf = result.pdf + select(fuzzy, layers.fuzz_choice * pdf * base_wi.z, T(0));
    }
    return {select(is_above, result.f, black()), select(is_above, result.pdf, T(0))};
  }

  /// What of reflected()'s f is of facets: of `sharp` gloss, those that mirror nearly as smooth ones do. wi: likewise.
  Rgb<T> gloss(const Lobes& layers, const Vec3<T>& wi, Gloss which) const;

  Rgb<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>&) const { return value(lobes(wo), wi).f; }
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const { return value(lobes(wo), wi).pdf; }
  BsdfSample<T> sample(const Vec3<T>& wo, const T& u, const T& u1, const T& u2) const {
    return sample(lobes(wo), u, u1, u2);
  }

  BsdfSample<T> sample(const Lobes& layers, const T& u, const T& u1, const T& u2) const {
    T before = layers.fuzz_choice;
    const auto next = [&](const T& choice) {
      const Mask<T> taken = (u >= before) & (u < before + choice);
      before = before + choice;
      return taken;
    };
    const Mask<T> on_fuzz = u < before, coated = next(layers.coat_choice);
    // What a facet of the base reflects, and what it lets through, is known when the facet is.
    const T u_of_facet = u - before;
    before = before + layers.facet_choice;
    const Mask<T> is_diffuse = u >= before, on_base = !(on_fuzz | coated | is_diffuse);
    const Mask<T> enters = is_diffuse & (u >= T(1) - layers.inside_choice);

    const auto facets =
        StretchedGgx<T>::of(select(coated, coat_roughness, roughness), select(coated, coat_anisotropy, anisotropy));
    const LayerFrames<T>* const frames = layers.frames;
    Vec3<T> from = layers.from;
    if (frames != nullptr) from = select(coated, coat_from(layers), from);
    const Mask<T> rough = facets.is_rough();
    const Vec3<T> facet = select(rough, facets.sample_facet(from, u1, u2), local_normal<T>());
    const T cosine = min(max(dot(from, facet), T(1e-6F)), T(1));
    T choice(1);
    Mask<T> through(false);
    if (any(on_base & lets_through())) {
      choice = reflection_choice(layers, cosine, at_facet(layers, cosine));
      through = on_base & (u_of_facet >= layers.facet_choice * choice);
    }
    const Vec3<T> mirrored = facet * (T(2) * cosine) - from;
    const Vec3<T> diffuse = Lambertian<T>{base}.sample(from, local_normal<T>(), u1, u2);
    Vec3<T> wi = normalize(select(is_diffuse, diffuse, mirrored));
    if (any(on_fuzz)) wi = select(on_fuzz, layers.fibers.sample(u1, u2), wi);
    T share(1), coat_cosine = wi.z;
    if (frames != nullptr) [[unlikely]] {
      const Vec3<T> own = wi;
      const auto of_layer = [&](const auto& f) {
        return select(coated, f(frames->coat), select(is_diffuse, f(frames->diffuse), f(frames->base)));
      };
      wi = of_layer([&](const LayerFrame<T>& layer) { return layer.from_own(own); });
      coat_cosine = frames->coat.to_own(wi).z;
      share = of_layer([&](const LayerFrame<T>& layer) { return layer.share(wi, own); });
    }
    Value above = reflected(layers, wi);
    // What the layer that drew it does not reflect is nothing to the others either.
    if (frames != nullptr) above = {select(share > T(0), above.f, black()), select(share > T(0), above.pdf, T(0))};
    // Of finitely many directions: as if of their own.
    const Mask<T> specular = !(rough | is_diffuse | on_fuzz);
    const Rgb<T> mirrored_part = select(coated, white() * (layers.coat_albedo * layers.under_fuzz),
                                        under_coat(layers, coat_cosine) * at_facet(layers, from.z));
    BsdfSample<T> result{wi, select(specular, mirrored_part * (share / from.z), above.f),
                         select(specular, select(coated, layers.coat_choice, layers.facet_choice * choice), above.pdf),
                         T(1), specular};
    if (any(through)) {
      const T density = layers.facet_choice * (T(1) - choice);
      result = select(through, refracted(layers, facets, facet, cosine, density), result);
    }
    if (any(enters)) [[unlikely]]
      result = select(enters, entered(layers, diffuse), result);
    return result;
  }

 private:
  static constexpr float glossy_roughness = 0.25F;

  /// What rough facets of the base reflect, and how often sample() draws wi by them.
  Value by_facets(const Lobes& layers, const Vec3<T>& base_wi) const {
    const auto reflection = ggx().reflection(layers.from, base_wi);
    const Rgb<T> reflectance = at_facet(layers, reflection.cosine);
    const T choice = layers.facet_choice * reflection_choice(layers, reflection.cosine, reflectance);
    return {reflectance * reflection.f, choice * reflection.pdf};
  }
  /// The same of the coat's.
  Value by_coat(const Lobes& layers, const Vec3<T>& wi, const Vec3<T>& coat_wi) const {
    auto reflection = coat_ggx().reflection(coat_from(layers), coat_wi);
    if (layers.frames != nullptr) layers.frames->coat.count_about_surface(wi, coat_wi, reflection.f, reflection.pdf);
    const T reflectance = fresnel_reflection(reflection.cosine, coat_eta).reflectance / layers.coat_share;
    return {white() * (coat * reflectance * reflection.f * layers.under_fuzz), layers.coat_choice * reflection.pdf};
  }

  static Rgb<T> white() { return Rgb<T>(T(1), T(1), T(1)); }
  static Rgb<T> black() { return Rgb<T>(T(0), T(0), T(0)); }
  static T square(const T& x) { return x * x; }
  static T mean(const Rgb<T>& c) { return (c.red + c.green + c.blue) * T(1.0F / 3); }
  static Rgb<T> exp_of(const Rgb<T>& a, const T& factor) {
    return {exp(a.red * factor), exp(a.green * factor), exp(a.blue * factor)};
  }
  static T normal_reflectance(const T& eta) { return square((eta - T(1)) / (eta + T(1))); }
  auto ggx() const { return StretchedGgx<T>::of(roughness, anisotropy); }
  auto coat_ggx() const { return StretchedGgx<T>::of(coat_roughness, coat_anisotropy); }
  auto is_thin() const { return thin > T(0); }

  const Vec3<T>& coat_from(const Lobes& layers) const {
    return layers.frames != nullptr ? layers.frames->coat.own_wo() : layers.from;
  }

  /// What is left of light between what is below coat and fuzz, and a direction of that cosine.
  Rgb<T> under_coat(const Lobes& layers, const T& cosine) const {
    const auto depth = [&](const T& c) {
      return T(1) / sqrt(max(T(1) - (T(1) - min(c * c, T(1))) / square(coat_eta), T(1e-3F)));
    };
    const Rgb<T> left = exp_of(coat_extinction, -(depth(coat_from(layers).z) + depth(cosine)));
    const auto channel = [&](const T& absorbed, const T& darkening) {
      return (T(1) - coat + (coat - layers.coat_albedo) * absorbed) * darkening * layers.under_fuzz;
    };
    return {channel(left.red, layers.darkening.red), channel(left.green, layers.darkening.green),
            channel(left.blue, layers.darkening.blue)};
  }

  /// What a facet of the base reflects at an angle of that cosine, over the shares of facets.
  Rgb<T> at_facet(const Lobes& layers, const T& cosine) const {
    const T reflectance = fresnel_reflection(cosine, eta).reflectance;
    const Rgb<T> bare = at_facet_of(layers, cosine, reflectance / layers.dielectric_share);
    const Mask<T> filmed = film.weight > T(0);
    return any(filmed) ? select(filmed, at_film(layers, cosine), bare) : bare;
  }
  /// reflected: by the dielectric, likewise.
  Rgb<T> at_facet_of(const Lobes& layers, const T& cosine, const T& reflected) const {
    const T lost = (T(1) - layers.white_share) / layers.white_share;
    const T pane = pane_reflectance(min(reflected * layers.dielectric_share, T(1))) / layers.white_share;
    const T dielectric = mix(reflected, pane, select(is_thin(), transmission, T(0)));
    const auto channel = [&](const T& normal, const T& color) {
      const T of_metal = f82_reflectance(normal, color, cosine) * (T(1) + normal * lost);
      return mix(dielectric * color, of_metal * specular_weight, metalness);
    };
    return {channel(metal.red, specular_color.red), channel(metal.green, specular_color.green),
            channel(metal.blue, specular_color.blue)};
  }

  /// Whether it matters what its boundary reflects at angles at which that is all: else all that it does not comes
  /// through.
  auto reflects_totally() const { return (eta < T(1)) & (transmission < T(1)); }
  auto lets_through() const { return transmission * (T(1) - metalness) > T(0); }
  /// How often sample() reflects light of a facet at an angle of that cosine, which reflects so much, and lets the rest
  /// through otherwise.
  T reflection_choice(const Lobes& layers, const T& cosine, const Rgb<T>& reflectance) const {
    const Mask<T> clear = lets_through();
    if (none(clear)) return T(1);
    const T bare = fresnel_reflection(cosine, eta).reflectance;
    const T let_through = T(1) - select(is_thin(), pane_reflectance(bare), bare);
    const T share = select(is_thin(), layers.white_share, layers.dielectric_share);
    const T through = (T(1) - metalness) * transmission * let_through * mean(tint) / share;
    const T reflected = mean(reflectance), all = reflected + through;
    return select(clear & (all > T(0)), reflected / all, T(1));
  }

  Rgb<T> metal_with_film(const T& cosine) const {
    if (none(metalness > T(0))) return black();
    return film.on_metal(cosine, metal, specular_color);
  }
  void set_film(Lobes& layers, const T& cosine) const;
  /// What facets reflect of which each reflects all at angles beyond the critical one. index: of the boundary, below 1.
  static T reflection_about_total(const StretchedGgx<T>& facets, const Vec3<T>& from, const T& index);
  /// As at_facet() and at_facet_of().
  [[gnu::noinline]] Rgb<T> at_film(const Lobes& layers, const T& cosine) const {
    const Rgb<T> reflected = film.on_dielectric(cosine, eta) / layers.film_share;
    return at_film_of(layers, reflected, metal_with_film(cosine));
  }
  Rgb<T> at_film_of(const Lobes& layers, const Rgb<T>& reflected, const Rgb<T>& of_metal) const {
    const T lost = (T(1) - layers.white_share) / layers.white_share;
    const auto channel = [&](const auto& c) {
      const T pane = pane_reflectance(min(reflected.*c * layers.film_share.*c, T(1))) / layers.white_share;
      const T dielectric = mix(reflected.*c, pane, select(is_thin(), transmission, T(0)));
      return mix(dielectric * specular_color.*c, of_metal.*c * (T(1) + metal.*c * lost) * specular_weight, metalness);
    };
    return {channel(&Rgb<T>::red), channel(&Rgb<T>::green), channel(&Rgb<T>::blue)};
  }

  /// A sample that goes in below the surface, where it spreads evenly. above: a diffuse one. What coat and film take of
  /// light that comes out is as if it came straight.
  [[gnu::noinline]] BsdfSample<T> entered(const Lobes& layers, const Vec3<T>& above) const {
    const Vec3<T> own{above.x, above.y, -above.z};
    const T share = (T(1) - metalness) * (T(1) - transmission), even = T(std::numbers::inv_pi_v<float>);
    const Rgb<T> bare = white() * (T(1) - layers.base_reflection);
    const Rgb<T> let_in = select(film.weight > T(0), layers.under_film, bare) * (share * even);
    BsdfSample<T> result{own, under_coat(layers, T(1)) * let_in * select(is_thin(), inside, white() * subsurface),
                         layers.inside_choice * above.z * even};
    result.enters = Mask<T>(true);
    if (layers.frames != nullptr) [[unlikely]] {
      result.wi = layers.frames->base.from_own(own);
      result.f = result.f * layers.frames->base.share_from_below(result.wi, own);
    }
    const Mask<T> comes = result.wi.z < T(-1e-6F);
    result.f = select(comes, result.f, black());
    result.pdf = select(comes, result.pdf, T(0));
    return result;
  }

  /// Through a facet of the base.
  struct Passage {
    Vec3<T> facet;
    T cosine;                      ///< of its angle with wo
    FresnelReflection<T> fresnel;  ///< of one boundary at it
    Vec3<T> own_wi;                ///< below the surface, in the base's frame
    T choice;                      ///< how often sample() lets light of that facet through
  };
  /// What comes through a facet into that direction, as through a dielectric's.
  BsdfSample<T> through_facet(const Lobes& layers, const StretchedGgx<T>& ggx, const Passage& way) const;
  /// A sample that comes through a facet. choice: as Passage has it.
  BsdfSample<T> refracted(const Lobes& layers, const StretchedGgx<T>& ggx, const Vec3<T>& facet, const T& cosine,
                          const T& choice) const;
  /// What comes through rough facets from wi below the surface.
  Value through_facets(const Lobes& layers, const Vec3<T>& wi) const;
};

}  // namespace raytrace

#include "raytrace/materials/openpbr_lobes.h"
#include "raytrace/materials/openpbr_through.h"
