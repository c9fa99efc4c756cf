// The scene's camera, whatever its type: one call a packet.
#pragma once

#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

class Camera {
 public:
  virtual ~Camera() = default;
  /// Rays through points of the picture, as cameras/kernels.h has them.
  virtual Ray<FloatN> generate(const FloatN& x, const FloatN& y) const = 0;
};

template <class CameraKernel>
class CameraOf final : public Camera {
 public:
  explicit CameraOf(const CameraKernel& camera) : camera_(camera) {}
  Ray<FloatN> generate(const FloatN& x, const FloatN& y) const override {
    return camera_.template generate<FloatN>(x, y);
  }

 private:
  CameraKernel camera_;
};

}  // namespace raytrace
