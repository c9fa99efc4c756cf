// The scene's camera, whatever its type, as the renderer sees it: one call a packet.
//
// A camera type provides, besides its Parameters and fields():
//   Camera(const Parameters&, double pixelsize);
//   template <class F> Ray<F> generate(const F& x, const F& y) const;
//   static CameraMatrices matrices(const Parameters&, const ViewPlane&);
//   Vec3f origin() const;            if all rays start there
#pragma once

#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

class Camera {
 public:
  virtual ~Camera() = default;
  /// Rays through points of the picture: x to the right and y upwards from its center, in pixels. Unit directions.
  virtual Ray<FloatN> generate(const FloatN& x, const FloatN& y) const = 0;
};

template <class Type>
class CameraOf final : public Camera {
 public:
  explicit CameraOf(const Type& camera) : camera_(camera) {}
  Ray<FloatN> generate(const FloatN& x, const FloatN& y) const override {
    return camera_.template generate<FloatN>(x, y);
  }

 private:
  Type camera_;
};

}  // namespace raytrace
