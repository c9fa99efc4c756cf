// How matte surfaces scatter light.
#pragma once

#include "raytrace/bsdfs/bsdf_sample.h"
#include "raytrace/bsdfs/lambertian.h"
#include "raytrace/materials/matte.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<Matte> {
 public:
  template <class T>
  struct Bsdf {
    Lambertian<T> ambient, diffuse;

    Rgb<T> ambient_radiance(const Rgb<T>& radiance) const { return ambient.rho() * radiance; }
    Rgb<T> albedo() const { return diffuse.rho(); }
    Rgb<T> evaluate(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&) const { return diffuse.f(); }
    BsdfSample<T> sample(const Vec3<T>& wo, const T&, const T& u1, const T& u2) const {
      const Vec3<T> wi = diffuse.sample(wo, local_normal<T>(), u1, u2);
      return {wi, diffuse.f(), pdf(wo, wi)};
    }
    T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const { return diffuse.pdf(wo, wi, local_normal<T>()); }
  };

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const Matte::Values<Value>& matte) {
    return {{Rgb<T>(matte.cd * matte.ka)}, {Rgb<T>(matte.cd * matte.kd)}};
  }
  static Bsdf<float> bsdf(const Matte::Parameters& parameters) { return bsdf_of<float>(parameters); }
};

}  // namespace raytrace
