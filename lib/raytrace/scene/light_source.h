// The lights of a scene, whatever their types, as the integrators have them: one call a packet.
#pragma once

#include <optional>

#include "raytrace/lights/light_sample.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/scene/many_lights.h"

namespace raytrace {

/// A light that shines from somewhere.
class LightSource {
 public:
  virtual ~LightSource() = default;
  /// Leads rays, whose origins are set, to the light, where they end. radiance: receives what arrives along them. u:
  /// where on the light, if it takes_samples().
  virtual void sample(Ray<FloatN>& shadow_rays, const Sample2D& u, Rgb<FloatN>& radiance) const = 0;
  virtual bool takes_samples() const = 0;
  virtual bool shadows() const = 0;
  /// Cuts the parts of rays, of unit length, between two distances to what it may light; to one distance where that is
  /// nothing.
  virtual void cut_to_lit(const Ray<FloatN>& rays, FloatN& begin, FloatN& end) const = 0;
  /// Where it is; none: infinitely far away.
  virtual std::optional<Vec3f> location() const = 0;
  /// Whether it is at a point, from where it falls off, and then adds it to lights that are drawn.
  virtual bool falls_off() const = 0;
  virtual void add_to(ManyLights& lights) const = 0;
  /// What no point gets more of; of a light that falls off, at distance 1.
  virtual Rgb<float> largest_radiance() const = 0;
};

template <class LightKernel>
class LightSourceOf final : public LightSource {
 public:
  explicit LightSourceOf(const LightKernel& light) : light_(light) {}
  void sample(Ray<FloatN>& shadow_rays, [[maybe_unused]] const Sample2D& u, Rgb<FloatN>& radiance) const override {
    LightSample<FloatN> sample;
    if constexpr (requires { light_.takes_samples(); })
      sample = takes_samples() ? light_.template sample<FloatN>(shadow_rays.origin, u.x, u.y)
                               : light_.template sample<FloatN>(shadow_rays.origin);
    else
      sample = light_.template sample<FloatN>(shadow_rays.origin);
    shadow_rays.direction = sample.to_light;
    shadow_rays.far = sample.t_max;
    radiance = sample.radiance;
  }
  bool takes_samples() const override {
    if constexpr (requires { light_.takes_samples(); }) return light_.takes_samples();
    return false;
  }
  bool shadows() const override { return light_.shadows(); }
  void cut_to_lit([[maybe_unused]] const Ray<FloatN>& rays, [[maybe_unused]] FloatN& begin,
                  [[maybe_unused]] FloatN& end) const override {
    if constexpr (requires { light_.cut_to_cone(rays, begin, end); }) light_.cut_to_cone(rays, begin, end);
  }
  std::optional<Vec3f> location() const override {
    if constexpr (requires { light_.location(); }) return light_.location();
    return std::nullopt;
  }
  bool falls_off() const override {
    if constexpr (requires { light_.falls_off(); }) return light_.falls_off();
    return false;
  }
  void add_to([[maybe_unused]] ManyLights& lights) const override {
    if constexpr (requires { light_.source(); }) lights.add(light_.source(), light_.photometric_share(), shadows());
  }
  Rgb<float> largest_radiance() const override { return light_.largest_radiance(); }

 private:
  LightKernel light_;
};

}  // namespace raytrace
