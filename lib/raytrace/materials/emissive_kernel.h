// What emissive surfaces send.
#pragma once

#include "raytrace/bsdfs/bsdf_sample.h"
#include "raytrace/materials/emissive.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<Emissive> {
 public:
  template <class T>
  struct Bsdf {
    Rgb<T> radiance;

    Rgb<T> emitted() const { return radiance; }
    Rgb<T> ambient_radiance(const Rgb<T>&) const { return none(); }
    Rgb<T> albedo() const { return none(); }
    Rgb<T> evaluate(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&) const { return none(); }
    BsdfSample<T> sample(const Vec3<T>&, const T&, const T&, const T&) const {
      return {local_normal<T>(), none(), T(0)};
    }
    T pdf(const Vec3<T>&, const Vec3<T>&) const { return T(0); }

   private:
    static Rgb<T> none() { return Rgb<T>(T(0), T(0), T(0)); }
  };

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const Emissive::Values<Value>& emissive) {
    return {Rgb<T>(emissive.ce * emissive.scaleradiance)};
  }
  static Bsdf<float> bsdf(const Emissive::Parameters& parameters) { return bsdf_of<float, double>(parameters); }
};

}  // namespace raytrace
