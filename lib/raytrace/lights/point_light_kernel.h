// What a point light sends to a point.
#pragma once

#include "raytrace/lights/light_sample.h"
#include "raytrace/lights/photometric_share_kernel.h"
#include "raytrace/lights/point_light.h"
#include "raytrace/lights/point_radiance.h"
#include "raytrace/lights/point_source.h"
#include "raytrace/math/kernel.h"

namespace raytrace {

template <>
class Kernel<PointLight> {
 public:
  explicit Kernel(const PointLight::Parameters& parameters, const LoadedPhotometry& photometry = {})
      : location_(parameters.location),
        photometric_(photometry, {0, -1, 0}),
        radiance_(parameters.color * parameters.scaleradiance, parameters.falloff),
        shadows_(parameters.shadows) {}

  static constexpr bool ambient = false;
  bool shadows() const { return shadows_; }
  Vec3f location() const { return location_; }
  Rgb<float> largest_radiance() const { return radiance_.at_distance_1(); }
  bool falls_off() const { return radiance_.falls_off(); }
  PointSource<float> source() const {
    return {location_, radiance_.at_distance_1(), radiance_.largest_share(), {0, 1, 0}, -2, 0};
  }
  const PhotometricShare& photometric_share() const { return photometric_; }

  template <class F>
  RAYTRACE_INLINE LightSample<F> sample(const Vec3<F>& p) const {
    const Vec3<F> to_light = Vec3<F>(location_) - p;
    return {to_light, F(1), radiance_.at(to_light) * photometric_.towards(to_light)};
  }

 private:
  Vec3f location_;
  PhotometricShare photometric_;
  PointRadiance radiance_;
  bool shadows_;
};

}  // namespace raytrace
