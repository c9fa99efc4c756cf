// What a directional light sends to a point.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "raytrace/lights/directional_light.h"
#include "raytrace/lights/light_sample.h"
#include "raytrace/math/frame.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/turns.h"

namespace raytrace {

template <>
class Kernel<DirectionalLight> {
 public:
  explicit Kernel(const DirectionalLight::Parameters& parameters)
      : direction_(normalize(parameters.direction)), shadows_(parameters.shadows) {
    const double sine = std::sin(parameters.angle * (std::numbers::pi / 720)), cap = 2 * sine * sine;
    cap_ = static_cast<float>(cap);
    // The mean cosine of the disk's directions is that of its edge and 1: a surface that faces it gets what it gets of
    // one without a size.
    radiance_ = Rgb<float>(parameters.color * (parameters.scaleradiance / (1 - cap / 2)));
  }

  static constexpr bool ambient = false;
  bool shadows() const { return shadows_; }
  Vec3f direction() const { return direction_; }
  Rgb<float> largest_radiance() const { return radiance_; }
  bool takes_samples() const { return cap_ > 0; }

  template <class F>
  RAYTRACE_INLINE LightSample<F> sample(const Vec3<F>&) const {
    return {Vec3<F>(direction_), F(std::numeric_limits<float>::infinity()), Rgb<F>(radiance_)};
  }
  template <class F>
  LightSample<F> sample(const Vec3<F>& p, const F& u1, const F& u2) const {
    LightSample<F> result = sample(p);
    const F cap = u1 * F(cap_), radius = sqrt(cap * (F(2) - cap));
    const auto around = sin_cos_of_turns(u2);
    result.to_light = Frame<F>(result.to_light).to_world({radius * around.cosine, radius * around.sine, F(1) - cap});
    return result;
  }

 private:
  Vec3f direction_;
  Rgb<float> radiance_;
  bool shadows_;
  float cap_;  ///< 1 - the cosine of half the disk's angle
};

}  // namespace raytrace
