// The radiance of ambient light.
#pragma once

#include "raytrace/lights/ambient_light.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<AmbientLight> {
 public:
  explicit Kernel(const AmbientLight::Parameters& parameters)
      : radiance_(parameters.color * parameters.scaleradiance) {}

  static constexpr bool ambient = true;
  Rgb<float> radiance() const { return radiance_; }

 private:
  Rgb<float> radiance_;
};

}  // namespace raytrace
