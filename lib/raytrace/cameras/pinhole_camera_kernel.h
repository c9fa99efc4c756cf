// The rays of a pinhole camera.
#pragma once

#include "raytrace/cameras/pinhole_camera.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

template <>
class Kernel<PinholeCamera> {
 public:
  Kernel(const PinholeCamera::Parameters& parameters, const ViewPlane& viewplane) : eye_(parameters.eye) {
    const ViewFrame frame(parameters.eye, parameters.lookat, parameters.up);
    const double pixel = viewplane.pixelsize / parameters.viewdistance;
    right_ = Vec3f(frame.u * pixel);
    up_ = Vec3f(frame.v * pixel);
    forward_ = Vec3f(-frame.w);
  }

  Vec3f origin() const { return eye_; }

  template <class F>
  Ray<F> generate(const F& x, const F& y) const {
    const Vec3<F> direction{multiply_add(F(right_.x), x, multiply_add(F(up_.x), y, F(forward_.x))),
                            multiply_add(F(right_.y), x, multiply_add(F(up_.y), y, F(forward_.y))),
                            multiply_add(F(right_.z), x, multiply_add(F(up_.z), y, F(forward_.z)))};
    return {Vec3<F>(eye_), normalize(direction), F(0), infinity<F>()};
  }

 private:
  Vec3f eye_;
  Vec3f right_, up_,
      forward_;  ///< one pixel to the right, one up, and to the view plane's center; divided by viewdistance
};

}  // namespace raytrace
