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

    template <class Front>
    void set_side(const Front& front, const Refraction<T>& media) {
      const T inside = media.inside(eta);
      eta = select(front | is_thin(), inside / media.outside, media.outside / inside);
    }

    Rgb<T> ambient_radiance(const Rgb<T>&) const { return black(); }
    Rgb<T> albedo() const { return reflected; }
    Rgb<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& normal) const {
      const Mask<T> rough = ggx().is_rough();
      if (none(rough)) return black();
      const Vec3<T> from = above_surface(wo, normal);
      const auto reflection = ggx().reflection(from, wi, normal);
      const T f = fresnel(reflection.cosine).reflectance * reflection.f / share(dot(from, normal));
      return select(rough, reflected * f, black());
    }
    T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
      const Vec3<T> normal = local_normal<T>();
      const auto reflection = ggx().reflection(above_surface(wo, normal), wi, normal);
      const T choice = reflection_choice(fresnel(reflection.cosine).reflectance);
      return select(ggx().is_rough(), choice * reflection.pdf, T(0));
    }

    BsdfSample<T> sample(const Vec3<T>& wo, const T& u, const T& u1, const T& u2) const {
      const Vec3<T> from = above_surface(wo, local_normal<T>());
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
        const T lambda_o = ggx().lambda(from.z), lambda_i = ggx().lambda(max(cosine_i, T(1e-6F)));
        const T across = max(abs(cosine - eta * below_cosine), T(1e-6F));
        const T spread = select(bends, eta * eta * below_cosine / (across * across), T(0.25F) / cosine);
        const T facets = ggx().density(facet.x * facet.x + facet.y * facet.y) * cosine / (from.z * (T(1) + lambda_o));
        shape = select(rough, ggx().unshadowed(lambda_o, lambda_i) / share(from.z), shape);
        density = select(rough, density * facets * spread, density);
      }
      const T f = select(cosine_i > T(1e-6F), shape * density / max(cosine_i, T(1e-6F)), T(0));
      return {wi, part * f, density, eta2, !rough};
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
