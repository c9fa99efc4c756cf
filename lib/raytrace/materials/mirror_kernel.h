// How mirrors reflect light. Their albedo, for denoisers, is what they reflect.
#pragma once

#include "raytrace/bsdfs/ggx.h"
#include "raytrace/materials/mirror.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<Mirror> {
 public:
  template <class T>
  struct Bsdf {
    Rgb<T> reflectance;

    static constexpr bool is_glossy = true;

    Rgb<T> ambient_radiance(const Rgb<T>&) const { return black(); }
    Rgb<T> albedo() const { return reflectance; }
    Rgb<T> evaluate(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&) const { return black(); }
    BsdfSample<T> sample(const Vec3<T>& wo, const T&, const T&, const T&) const {
      const T z = above_surface(wo, local_normal<T>()).z;
      return {{-wo.x, -wo.y, z}, reflectance * (T(1) / z), T(1), T(1), Mask<T>(true)};
    }
    T pdf(const Vec3<T>&, const Vec3<T>&) const { return T(0); }

   private:
    static Rgb<T> black() { return Rgb<T>(T(0), T(0), T(0)); }
  };

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const Mirror::Values<Value>& mirror) {
    return {Rgb<T>(mirror.cr)};
  }
  static Bsdf<float> bsdf(const Mirror::Parameters& parameters) { return bsdf_of<float>(parameters); }
};

}  // namespace raytrace
