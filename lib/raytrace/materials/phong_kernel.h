// How Phong surfaces scatter light.
#pragma once

#include "raytrace/bsdfs/bsdf_sample.h"
#include "raytrace/bsdfs/glossy_specular.h"
#include "raytrace/bsdfs/lambertian.h"
#include "raytrace/materials/phong.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<Phong> {
 public:
  template <class T>
  struct Bsdf {
    Lambertian<T> ambient, diffuse;
    GlossySpecular<T> specular;

    Rgb<T> ambient_radiance(const Rgb<T>& radiance) const { return ambient.rho() * radiance; }
    Rgb<T> albedo() const { return diffuse.rho(); }
    Rgb<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& normal) const {
      return diffuse.f() + specular.f(wo, wi, normal);
    }
    Rgb<T> gloss(const Vec3<T>& wo, const Vec3<T>& wi) const { return specular.f(wo, wi, local_normal<T>()); }
    /// The diffuse lobe and the highlight, each as often as it reflects of light from straight above.
    BsdfSample<T> sample(const Vec3<T>& wo, const T& u, const T& u1, const T& u2) const {
      const Vec3<T> normal = local_normal<T>();
      const Vec3<T> wi =
          select(u < diffuse_share(), diffuse.sample(wo, normal, u1, u2), specular.sample(wo, normal, u1, u2));
      return {wi, select(wi.z > T(0), evaluate(wo, wi, normal), Rgb<T>(T(0), T(0), T(0))), pdf(wo, wi)};
    }
    T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
      const T share = diffuse_share();
      return share * diffuse.pdf(wo, wi, local_normal<T>()) + (T(1) - share) * specular.pdf(wo, wi, local_normal<T>());
    }

   private:
    /// In [0, 1]; 1 of a material that reflects nothing.
    T diffuse_share() const {
      const auto sum = [](const Rgb<T>& color) { return color.red + color.green + color.blue; };
      const T of_diffuse = sum(diffuse.rho()), all = of_diffuse + sum(specular.rho());
      return select(all > T(0), of_diffuse / all, T(1));
    }
  };

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const Phong::Values<Value>& phong) {
    return {{Rgb<T>(phong.cd * phong.ka)},
            {Rgb<T>(phong.cd * phong.kd)},
            {Rgb<T>(phong.cs * phong.ks), static_cast<T>(phong.exp)}};
  }
  static Bsdf<float> bsdf(const Phong::Parameters& parameters) { return bsdf_of<float>(parameters); }
};

}  // namespace raytrace
