// The lights of a scene, whatever their types, as the integrators see them: one call a packet.
#pragma once

#include <memory>
#include <vector>

#include "raytrace/lights/light.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// A light that shines from somewhere.
class LightSource {
 public:
  virtual ~LightSource() = default;
  virtual LightSample<FloatN> sample(const Vec3<FloatN>& position) const = 0;
  virtual bool shadows() const = 0;
  virtual Rgb<float> largest_radiance() const = 0;
};

template <class Light>
class LightSourceOf final : public LightSource {
 public:
  explicit LightSourceOf(const Light& light) : light_(light) {}
  LightSample<FloatN> sample(const Vec3<FloatN>& position) const override {
    return light_.template sample<FloatN>(position);
  }
  bool shadows() const override { return light_.shadows(); }
  Rgb<float> largest_radiance() const override { return light_.largest_radiance(); }

 private:
  Light light_;
};

}  // namespace raytrace
