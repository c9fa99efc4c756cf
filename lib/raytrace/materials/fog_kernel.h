// What is inside of fog. Rays do not meet its surface, so that nothing asks for a BSDF.
#pragma once

#include <algorithm>
#include <optional>

#include "raytrace/bsdfs/bsdf_sample.h"
#include "raytrace/materials/fog.h"
#include "raytrace/materials/medium.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<Fog> {
 public:
  template <class T>
  struct Bsdf {
    Rgb<T> color;

    Rgb<T> ambient_radiance(const Rgb<T>&) const { return black(); }
    Rgb<T> albedo() const { return color; }
    Rgb<T> evaluate(const Vec3<T>&, const Vec3<T>&, const Vec3<T>&) const { return black(); }
    BsdfSample<T> sample(const Vec3<T>& wo, const T&, const T&, const T&) const {
      return {-wo, black(), T(0), T(1), Mask<T>(true)};
    }
    T pdf(const Vec3<T>&, const Vec3<T>&) const { return T(0); }

   private:
    static Rgb<T> black() { return Rgb<T>(T(0), T(0), T(0)); }
  };

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const Fog::Values<Value>& fog) {
    return {Rgb<T>(fog.color)};
  }
  static Bsdf<float> bsdf(const Fog::Parameters& parameters) { return bsdf_of<float>(parameters); }

  static std::optional<Medium> medium(const Fog::Parameters& parameters, const Bsdf<float>& bsdf) {
    const auto extinction = static_cast<float>(std::clamp(parameters.density / parameters.meanfreepath, 1e-30, 1e30));
    Medium medium;
    medium.priority = Medium::fog_priority;
    medium.extinction = Rgb<float>(extinction, extinction, extinction);
    medium.scattering = bsdf.color * extinction;
    medium.emission = Rgb<float>(parameters.ce);
    medium.anisotropy = static_cast<float>(std::clamp(parameters.anisotropy, -0.98, 0.98));
    return medium;
  }
};

}  // namespace raytrace
