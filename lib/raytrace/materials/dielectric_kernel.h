// How clear surfaces reflect and refract light. Their albedo, for denoisers, is the color of what they reflect.
#pragma once

#include <optional>

#include "raytrace/bsdfs/ggx_shares.h"
#include "raytrace/materials/dielectric.h"
#include "raytrace/materials/medium.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<Dielectric> {
 public:
  template <class T>
  struct Bsdf {
    T eta;  ///< index of refraction behind the surface, over that on wo's side
    T roughness, thin;
    Rgb<T> reflected, transmitted;  ///< what these are multiplied by
    Rgb<T> extinction;              ///< inside, for a unit of length

    /// evaluate() is in the local frame, as all others are.
    static constexpr bool in_local_frame = true;
    static constexpr bool is_glossy = true;

    template <class Front>
    void set_side(const Front& front, const Refraction<T>& media) {
      const T inside = media.inside(eta);
      eta = select(front | is_thin(), inside / media.outside, media.outside / inside);
    }

    Rgb<T> ambient_radiance(const Rgb<T>&) const { return black(); }
    Rgb<T> albedo() const { return reflected; }
    Rgb<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>&) const { return value(lobes(wo), wi).f; }
    T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const { return value(lobes(wo), wi).pdf; }

    /// What all directions of light have in common for one wo, in the local frame.
    struct Lobes {
      Vec3<T> from;
      T share;
    };
    struct Value {
      Rgb<T> f;
      T pdf;
    };
    Lobes lobes(const Vec3<T>& wo) const {
      const Vec3<T> from = above_surface(wo, local_normal<T>());
      return {from, any(ggx().is_rough()) ? share(from.z) : T(1)};
    }
    BsdfSample<T> sample(const Lobes& lobes, const T& u, const T& u1, const T& u2) const {
      const Vec3<T>& from = lobes.from;
      const Mask<T> rough = ggx().is_rough();
      Vec3<T> facet = local_normal<T>();
      if (any(rough)) facet = select(rough, ggx().sample_facet(from, u1, u2), facet);

      const T cosine = min(max(dot(from, facet), T(1e-6F)), T(1));
      const auto [reflectance, below_cosine] = fresnel(cosine);
      const T choice = reflection_choice(reflectance);
      const Mask<T> reflects = u < choice, bends = !(reflects | is_thin());
      const Vec3<T> mirrored = facet * (T(2) * cosine) - from;
      const Vec3<T> refracted = facet * (cosine / eta - below_cosine) - from * (T(1) / eta);
      Vec3<T> wi = select(bends, refracted, mirrored);
      wi.z = select((!reflects) & is_thin(), -wi.z, wi.z);
      // As a share of what arrives, and the density of the facet times that of wi for a facet.
      const T eta2 = select(bends, eta * eta, T(1));
      const Rgb<T> part = select(reflects, reflected * (reflectance / choice),
                                 transmitted * ((T(1) - reflectance) / ((T(1) - choice) * eta2)));
      const T cosine_i = select(reflects, wi.z, -wi.z);
      T shape = T(1), density = select(reflects, choice, T(1) - choice);
      if (any(rough)) {
        shape = select(rough, unshadowed(from, cosine_i) / lobes.share, shape);
        density =
            select(rough, density * facet_density(from, facet, cosine) * spread(bends, cosine, below_cosine), density);
      }
      const T f = select(cosine_i > T(1e-6F), shape * density / max(cosine_i, T(1e-6F)), T(0));
      return {wi, part * f, density, eta2, !rough};
    }
    BsdfSample<T> sample(const Vec3<T>& wo, const T& u, const T& u1, const T& u2) const {
      return sample(lobes(wo), u, u1, u2);
    }
    Value value(const Lobes& lobes, const Vec3<T>& wi) const {
      const Mask<T> rough = ggx().is_rough();
      Value result{black(), T(0)};
      if (none(rough)) return result;
      const auto reflection = ggx().reflection(lobes.from, wi, local_normal<T>());
      const T reflectance = fresnel(reflection.cosine).reflectance;
      result.f = select(rough, reflected * (reflectance * reflection.f / lobes.share), result.f);
      result.pdf = select(rough, reflection_choice(reflectance) * reflection.pdf, result.pdf);
      if (const Mask<T> through = rough & (wi.z < T(-1e-6F)); any(through)) {
        const Value from_behind = through_facet(lobes, wi);
        result.f = select(through, from_behind.f, result.f);
        result.pdf = select(through, from_behind.pdf, result.pdf);
      }
      return result;
    }

    /// Of a smooth one that is thin.
    Rgb<T> straight(const Vec3<T>& wo) const {
      const T cosine = min(above_surface(wo, local_normal<T>()).z, T(1));
      return transmitted * (T(1) - fresnel(cosine).reflectance);
    }
    Rgb<T> transmittance(const T& distance) const {
      return {exp(-extinction.red * distance), exp(-extinction.green * distance), exp(-extinction.blue * distance)};
    }

    /// As of a conductor.
    Rgb<T> usual_f() const { return select(ggx().is_rough(), reflected, black()); }

   private:
    static Rgb<T> black() { return Rgb<T>(T(0), T(0), T(0)); }
    static T largest(const Rgb<T>& color) { return max(max(abs(color.red), abs(color.green)), abs(color.blue)); }
    Ggx<T> ggx() const { return {roughness * roughness}; }
    auto is_thin() const { return thin > T(0); }

    T unshadowed(const Vec3<T>& from, const T& cosine_i) const {
      return ggx().unshadowed(ggx().lambda(from.z), ggx().lambda(max(cosine_i, T(1e-6F))));
    }
    /// Of the facets that sample() draws.
    T facet_density(const Vec3<T>& from, const Vec3<T>& facet, const T& cosine) const {
      const T lambda_o = ggx().lambda(from.z);
      return ggx().density(facet.x * facet.x + facet.y * facet.y) * cosine / (from.z * (T(1) + lambda_o));
    }
    /// The density of directions for a facet over that of facets.
    T spread(const auto& bends, const T& cosine, const T& below_cosine) const {
      const T across = max(abs(cosine - eta * below_cosine), T(1e-6F));
      return select(bends, eta * eta * below_cosine / (across * across), T(0.25F) / cosine);
    }
    /// Where wi is below the surface, and that is rough.
    Value through_facet(const Lobes& lobes, const Vec3<T>& wi) const {
      const Vec3<T>& from = lobes.from;
      const Mask<T> bends = !is_thin();
      const Vec3<T> sum = from + select(bends, wi * eta, Vec3<T>{wi.x, wi.y, -wi.z});
      const T length = sqrt(max(dot(sum, sum), T(1e-12F)));
      const Vec3<T> facet = sum * (T(1) / select(sum.z < T(0), -length, length));
      const T cosine = min(dot(from, facet), T(1));
      const auto [reflectance, below_cosine] = fresnel(max(cosine, T(1e-6F)));
      const T choice = reflection_choice(reflectance);
      const Mask<T> is_there = (cosine > T(1e-6F)) & (choice < T(1)) & (is_thin() | (dot(wi, facet) < T(0)));
      const T pdf = (T(1) - choice) * facet_density(from, facet, cosine) * spread(bends, cosine, below_cosine);
      const T eta2 = select(bends, eta * eta, T(1));
      const T part = (T(1) - reflectance) / ((T(1) - choice) * eta2);
      const T f = part * unshadowed(from, -wi.z) / lobes.share * pdf / max(-wi.z, T(1e-6F));
      return {select(is_there, transmitted * f, black()), select(is_there, pdf, T(0))};
    }

    FresnelReflection<T> fresnel(const T& cosine) const {
      FresnelReflection<T> result = fresnel_reflection(cosine, eta);
      result.reflectance = select(is_thin(), pane_reflectance(result.reflectance), result.reflectance);
      return result;
    }
    /// The probability with which sample() reflects: as much as comes of it.
    T reflection_choice(const T& reflectance) const {
      const T of_reflection = reflectance * largest(reflected);
      const T all = of_reflection + (T(1) - reflectance) * largest(transmitted);
      return select(all > T(0), of_reflection / all, T(1));
    }
    /// What is sent on of light from a direction of that cosine, if it meets one facet.
    T share(const T& cosine) const {
      const T at_most_one = min(cosine, T(1));
      if (none(is_thin())) return ggx_dielectric_share(at_most_one, roughness, eta);
      const T of_thin = ggx_reflected_share(at_most_one, roughness);
      if (none(!is_thin())) return of_thin;
      return select(is_thin(), of_thin, ggx_dielectric_share(at_most_one, roughness, eta));
    }
  };

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const Dielectric::Values<Value>& dielectric) {
    const auto extinction = [&](const Value& color) {
      using std::log;
      using std::max;
      const Value distance = max(dielectric.attenuationdistance, Value(1e-30F));
      return static_cast<T>(-log(max(color, Value(1e-30F))) / distance);
    };
    const Rgb<Value>& color = dielectric.attenuationcolor;
    return {static_cast<T>(dielectric.ior),  static_cast<T>(dielectric.roughness),
            static_cast<T>(dielectric.thin), Rgb<T>(dielectric.cr),
            Rgb<T>(dielectric.ct),           {extinction(color.red), extinction(color.green), extinction(color.blue)}};
  }
  static Bsdf<float> bsdf(const Dielectric::Parameters& parameters) {
    return bsdf_of<float, double>(Dielectric::values(parameters));
  }
  static std::optional<Medium> medium(const Dielectric::Parameters& parameters, const Bsdf<float>& bsdf) {
    if (parameters.thinwalled) return std::nullopt;
    return Medium{bsdf.eta, parameters.priority, bsdf.extinction, static_cast<float>(dispersion_of(parameters.abbe))};
  }
};

}  // namespace raytrace
