// What a directional light sends to a point.
#pragma once

#include <limits>

#include "raytrace/lights/directional_light.h"
#include "raytrace/lights/light_sample.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<DirectionalLight> {
 public:
  explicit Kernel(const DirectionalLight::Parameters& parameters)
      : direction_(normalize(parameters.direction)),
        radiance_(parameters.color * parameters.scaleradiance),
        shadows_(parameters.shadows) {}

  static constexpr bool ambient = false;
  bool shadows() const { return shadows_; }
  Vec3f direction() const { return direction_; }
  Rgb<float> largest_radiance() const { return radiance_; }

  template <class F>
  RAYTRACE_INLINE LightSample<F> sample(const Vec3<F>&) const {
    return {Vec3<F>(direction_), F(std::numeric_limits<float>::infinity()), Rgb<F>(radiance_)};
  }

 private:
  Vec3f direction_;
  Rgb<float> radiance_;
  bool shadows_;
};

}  // namespace raytrace
