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
    static constexpr bool is_glossy = true;

    Rgb<T> ambient_radiance(const Rgb<T>&) const { return black(); }
    Rgb<T> albedo() const { return normal; }
    /// What all directions of light have in common for one wo, in the local frame.
    struct Lobes {
      Vec3<T> from;
      StretchedGgx<T> stretched;
      Rgb<T> gain;
    };
    struct Value {
      Rgb<T> f;
      T pdf;
    };
    Lobes lobes(const Vec3<T>& wo) const {
      Lobes lobes{above_surface(wo, local_normal<T>()), {T(1), T(1)}, black()};
      if (any(is_stretched())) lobes.stretched = StretchedGgx<T>::of(roughness, anisotropy);
      if (any(ggx().is_rough()))
        lobes.gain = gain(by_kind([&] { return ggx_reflected_share(min(lobes.from.z, T(1)), roughness); },
                                  [&] { return stretched_reflected_share(lobes.stretched, lobes.from); }));
      return lobes;
    }
    BsdfSample<T> sample(const Lobes& lobes, const T&, const T& u1, const T& u2) const {
      const Vec3<T>& from = lobes.from;
      const BsdfSample<T> mirrored{
          {-from.x, -from.y, from.z}, reflectance(min(from.z, T(1))) * (T(1) / from.z), T(1), T(1), Mask<T>(true)};
      const Mask<T> rough = ggx().is_rough();
      if (none(rough)) return mirrored;
      const Vec3<T> facet = by_kind([&] { return ggx().sample_facet(from, u1, u2); },
                                    [&] { return lobes.stretched.sample_facet(from, u1, u2); });
      const Vec3<T> wi = normalize(facet * (T(2) * dot(from, facet)) - from);
      const Value reflected = value_of_rough(lobes, wi);
      return select(rough, BsdfSample<T>{wi, reflected.f, reflected.pdf}, mirrored);
    }
    BsdfSample<T> sample(const Vec3<T>& wo, const T& u, const T& u1, const T& u2) const {
      return sample(lobes(wo), u, u1, u2);
    }
    Value value(const Lobes& lobes, const Vec3<T>& wi) const {
      const Mask<T> rough = ggx().is_rough();
      if (none(rough)) return {black(), T(0)};
      const Value reflected = value_of_rough(lobes, wi);
      return {select(rough, reflected.f, black()), select(rough, reflected.pdf, T(0))};
    }
    Rgb<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& surface_normal) const {
      if (any(is_stretched())) return value(lobes(wo), wi).f;
      const Mask<T> rough = ggx().is_rough();
      if (none(rough)) return black();
      const Vec3<T> from = above_surface(wo, surface_normal);
      const T share = ggx_reflected_share(min(dot(from, surface_normal), T(1)), roughness);
      return select(rough, f(ggx().reflection(from, wi, surface_normal), gain(share)), black());
    }
    T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const { return value(lobes(wo), wi).pdf; }
    /// What a highlight is expected to have, of lights' radiance: little of a picture is in the middle of a narrow one.
    Rgb<T> usual_f() const { return select(ggx().is_rough(), normal, black()); }

   private:
    static Rgb<T> black() { return Rgb<T>(T(0), T(0), T(0)); }
    Ggx<T> ggx() const { return {roughness * roughness}; }
    auto is_stretched() const { return anisotropy > T(0); }
    /// Lane by lane: of facets that are not stretched, and of those that are.
    template <class Even, class Stretched>
    auto by_kind(const Even& even, const Stretched& stretched) const {
      if (none(is_stretched())) return even();
      if (none(!is_stretched())) return stretched();
      return select(is_stretched(), stretched(), even());
    }

    Rgb<T> reflectance(const T& cosine) const {
      const T rest = T(1) - cosine, square = rest * rest, fifth = square * square * rest;
      return normal + rise * fifth + dip * (-cosine * fifth * rest);
    }
    /// What is lost at one facet meets others: the paler the metal, the more of it comes out. share: that is not lost.
    Rgb<T> gain(const T& share) const { return Rgb<T>(T(1), T(1), T(1)) + normal * ((T(1) - share) / share); }
    Rgb<T> f(const typename Ggx<T>::Reflection& reflection, const Rgb<T>& gain) const {
      return reflectance(reflection.cosine) * gain * reflection.f;
    }
    Value value_of_rough(const Lobes& lobes, const Vec3<T>& wi) const {
      const auto reflection = by_kind([&] { return ggx().reflection(lobes.from, wi, local_normal<T>()); },
                                      [&] { return lobes.stretched.reflection(lobes.from, wi); });
      return {f(reflection, lobes.gain), reflection.pdf};
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
