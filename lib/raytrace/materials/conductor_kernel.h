// How metals reflect light. Their albedo, for denoisers, is what they reflect straight back.
#pragma once

#include "raytrace/bsdfs/fresnel.h"
#include "raytrace/bsdfs/ggx_shares.h"
#include "raytrace/bsdfs/stretched_shares.h"
#include "raytrace/materials/conductor.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<Conductor> {
 public:
  template <class T>
  struct Bsdf {
    // A facet reflects normal + rise (1 - c)^5 - dip c (1 - c)^6 of light at an angle of the cosine c.
    Rgb<T> normal, rise, dip;
    T roughness, anisotropy;

    /// Where all materials of a scene are isotropic, evaluate() is in any frame.
    static constexpr bool in_local_frame = false;

    Rgb<T> ambient_radiance(const Rgb<T>&) const { return black(); }
    Rgb<T> albedo() const { return normal; }
    Rgb<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& surface_normal) const {
      const Mask<T> rough = ggx().is_rough();
      if (none(rough)) return black();
      const Vec3<T> from = above_surface(wo, surface_normal);
      return select(rough, f(reflection(from, wi, surface_normal), from, dot(from, surface_normal)), black());
    }
    BsdfSample<T> sample(const Vec3<T>& wo, const T&, const T& u1, const T& u2) const {
      const Vec3<T> from = above_surface(wo, local_normal<T>());
      const BsdfSample<T> mirrored{
          {-from.x, -from.y, from.z}, reflectance(min(from.z, T(1))) * (T(1) / from.z), T(1), T(1), Mask<T>(true)};
      const Mask<T> rough = ggx().is_rough();
      if (none(rough)) return mirrored;
      Vec3<T> facet = ggx().sample_facet(from, u1, u2);
      if (any(is_stretched())) facet = select(is_stretched(), stretched().sample_facet(from, u1, u2), facet);
      const Vec3<T> wi = normalize(facet * (T(2) * dot(from, facet)) - from);
      const auto reflected = reflection(from, wi, local_normal<T>());
      return select(rough, BsdfSample<T>{wi, f(reflected, from, from.z), reflected.pdf}, mirrored);
    }
    T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
      const Vec3<T> normal_here = local_normal<T>();
      return select(ggx().is_rough(), reflection(above_surface(wo, normal_here), wi, normal_here).pdf, T(0));
    }
    /// What a highlight is expected to have, of lights' radiance: little of a picture is in the middle of a narrow one.
    Rgb<T> usual_f() const { return select(ggx().is_rough(), normal, black()); }

   private:
    static Rgb<T> black() { return Rgb<T>(T(0), T(0), T(0)); }
    Ggx<T> ggx() const { return {roughness * roughness}; }
    StretchedGgx<T> stretched() const { return StretchedGgx<T>::of(roughness, anisotropy); }
    auto is_stretched() const { return anisotropy > T(0); }
    typename Ggx<T>::Reflection reflection(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& surface_normal) const {
      auto result = ggx().reflection(wo, wi, surface_normal);
      if (any(is_stretched())) {
        const auto own = stretched().reflection(wo, wi);
        result.f = select(is_stretched(), own.f, result.f);
        result.pdf = select(is_stretched(), own.pdf, result.pdf);
      }
      return result;
    }

    Rgb<T> reflectance(const T& cosine) const {
      const T rest = T(1) - cosine, square = rest * rest, fifth = square * square * rest;
      return normal + rise * fifth + dip * (-cosine * fifth * rest);
    }
    Rgb<T> f(const typename Ggx<T>::Reflection& reflection, const Vec3<T>& wo, const T& cosine_o) const {
      // What is lost at one facet meets others: the paler the metal, the more of it comes out.
      T share = ggx_reflected_share(min(cosine_o, T(1)), roughness);
      if (any(is_stretched())) share = select(is_stretched(), stretched_reflected_share(stretched(), wo), share);
      const T lost = (T(1) - share) / share;
      return reflectance(reflection.cosine) * (Rgb<T>(T(1), T(1), T(1)) + normal * lost) * reflection.f;
    }
  };

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const Conductor::Values<Value>& conductor) {
    Bsdf<T> bsdf;
    const auto set = [&](auto channel, auto bsdf_channel) {
      const T normal = static_cast<T>(conductor.cr.*channel), edge = static_cast<T>(conductor.edgecolor.*channel);
      const Rgb<Value>& all = conductor.edgecolor;
      const auto has_edge = all.red + all.green + all.blue > Value(0);
      bsdf.normal.*bsdf_channel = normal;
      bsdf.rise.*bsdf_channel = pick(has_edge, T(T(1) - normal));
      bsdf.dip.*bsdf_channel = pick(has_edge, f82_dip(normal, edge));
    };
    set(&Rgb<Value>::red, &Rgb<T>::red);
    set(&Rgb<Value>::green, &Rgb<T>::green);
    set(&Rgb<Value>::blue, &Rgb<T>::blue);
    bsdf.roughness = static_cast<T>(conductor.roughness);
    bsdf.anisotropy = static_cast<T>(conductor.anisotropy);
    return bsdf;
  }
  static Bsdf<float> bsdf(const Conductor::Parameters& parameters) {
    return bsdf_of<float, double>(Conductor::values(parameters));
  }

 private:
  static float pick(bool mask, float value) { return mask ? value : 0; }
  template <class M, class T>
  static T pick(const M& mask, const T& value) {
    return select(mask, value, T(0));
  }
};

}  // namespace raytrace
