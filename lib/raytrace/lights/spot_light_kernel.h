// What a spotlight sends to a point.
#pragma once

#include <cmath>
#include <numbers>

#include "raytrace/lights/light_sample.h"
#include "raytrace/lights/photometric_share_kernel.h"
#include "raytrace/lights/point_radiance.h"
#include "raytrace/lights/spot_light.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/simd.h"

namespace raytrace {

template <>
class Kernel<SpotLight> {
 public:
  explicit Kernel(const SpotLight::Parameters& parameters, const LoadedPhotometry& photometry = {})
      : location_(parameters.location),
        towards_(normalize(parameters.location - parameters.lookat)),
        photometric_(photometry, -towards_),
        radiance_(parameters.color * parameters.scaleradiance, parameters.falloff),
        shadows_(parameters.shadows) {
    const double degree = std::numbers::pi / 180, edge = parameters.coneangle / 2;
    edge_cosine_ = static_cast<float>(std::cos(edge * degree));
    const double inner_cosine = std::cos((edge - parameters.penumbraangle) * degree);
    inverse_width_ = parameters.penumbraangle > 0 ? static_cast<float>(1 / (inner_cosine - edge_cosine_)) : 0;
  }

  static constexpr bool ambient = false;
  bool shadows() const { return shadows_; }
  Vec3f location() const { return location_; }
  Rgb<float> largest_radiance() const { return radiance_.at_distance_1(); }
  bool falls_off() const { return radiance_.falls_off(); }

  template <class F>
  RAYTRACE_INLINE LightSample<F> sample(const Vec3<F>& p) const {
    const Vec3<F> to_light = Vec3<F>(location_) - p;
    const F above_edge = dot(normalize(to_light), Vec3<F>(towards_)) - F(edge_cosine_);
    F share = F(1);
    if (inverse_width_ > 0) {
      // As in pbrt: a cubic in the cosine, without corners at either end.
      const F x = min(above_edge * F(inverse_width_), F(1));
      share = x * x * (F(3) - F(2) * x);
    }
    share = select(above_edge >= F(0), share, F(0)) * photometric_.towards(to_light);
    return {to_light, F(1), radiance_.at(to_light) * share};  // nothing for NaN
  }

 private:
  Vec3f location_;
  Vec3f towards_;  ///< against the axis of the cone, of unit length
  PhotometricShare photometric_;
  PointRadiance radiance_;
  bool shadows_;
  float edge_cosine_, inverse_width_;  ///< of the penumbra, in cosines; 0: there is none
};

}  // namespace raytrace
