// The rays of an orthographic camera.
#pragma once

#include "raytrace/cameras/orthographic_camera.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

template <>
class Kernel<OrthographicCamera> {
 public:
  Kernel(const OrthographicCamera::Parameters& parameters, const ViewPlane& viewplane) : eye_(parameters.eye) {
    const ViewFrame frame(parameters.eye, parameters.lookat, parameters.up);
    right_ = Vec3f(frame.u * viewplane.pixelsize);
    up_ = Vec3f(frame.v * viewplane.pixelsize);
    forward_ = Vec3f(-frame.w);
  }

  template <class F>
  Ray<F> generate(const F& x, const F& y) const {
    const Vec3<F> origin{multiply_add(F(right_.x), x, multiply_add(F(up_.x), y, F(eye_.x))),
                         multiply_add(F(right_.y), x, multiply_add(F(up_.y), y, F(eye_.y))),
                         multiply_add(F(right_.z), x, multiply_add(F(up_.z), y, F(eye_.z)))};
    return {origin, Vec3<F>(forward_), F(0), infinity<F>()};
  }

 private:
  Vec3f eye_, right_, up_;  ///< right_, up_: to the next pixel
  Vec3f forward_;           ///< unit length
};

}  // namespace raytrace
