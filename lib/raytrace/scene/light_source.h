// The lights of a scene, whatever their types, as the integrators have them: one call a packet.
#pragma once

#include "raytrace/lights/light_sample.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// A light that shines from somewhere.
class LightSource {
 public:
  virtual ~LightSource() = default;
  /// Leads rays, whose origins are set, to the light, where they end. radiance: receives what arrives along them.
  virtual void sample(Ray<FloatN>& shadow_rays, Rgb<FloatN>& radiance) const = 0;
  virtual bool shadows() const = 0;
};

template <class LightKernel>
class LightSourceOf final : public LightSource {
 public:
  explicit LightSourceOf(const LightKernel& light) : light_(light) {}
  void sample(Ray<FloatN>& shadow_rays, Rgb<FloatN>& radiance) const override {
    const LightSample<FloatN> sample = light_.template sample<FloatN>(shadow_rays.origin);
    shadow_rays.direction = sample.to_light;
    shadow_rays.far = sample.t_max;
    radiance = sample.radiance;
  }
  bool shadows() const override { return light_.shadows(); }

 private:
  LightKernel light_;
};

}  // namespace raytrace
