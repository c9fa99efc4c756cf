// The rays of a fisheye camera.
#pragma once

#include <algorithm>

#include "raytrace/cameras/fisheye_camera.h"
#include "raytrace/cameras/pixel_frame.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/turns.h"

namespace raytrace {

template <>
class Kernel<FisheyeCamera> {
 public:
  Kernel(const FisheyeCamera::Parameters& parameters, const ViewPlane& viewplane)
      : frame_(parameters.eye, ViewFrame(parameters.eye, parameters.lookat, parameters.up)),
        radius_(std::min(viewplane.hres, viewplane.vres) / 2.0),
        turns_per_pixel_(parameters.angle / 720 / radius_) {}

  Vec3f origin() const { return frame_.vectors<float>().eye; }

  MaskN has_ray(const FloatN& x, const FloatN& y) const {
    return x * x + y * y <= FloatN(static_cast<float>(radius_ * radius_));
  }

  template <class F>
  Ray<F> generate(const F& x, const F& y) const {
    using Number = LaneNumber<F>;
    const auto& frame = frame_.vectors<F>();
    const F radius = sqrt(x * x + y * y);
    const auto [sine, cosine] = sin_cos_of_turns(radius * F(static_cast<Number>(turns_per_pixel_)));
    const F scale = sine / max(radius, F(static_cast<Number>(1e-20)));  // 0 in the middle
    const Vec3<F> forward = Vec3<F>(frame.forward) * cosine;
    return {Vec3<F>(frame.eye), normalize(forward + frame.at_pixel(Vec3<Number>(0, 0, 0), x, y) * scale), F(0),
            infinity<F>()};
  }

 private:
  PixelFrame frame_;
  double radius_;  ///< of the circle, in pixels
  double turns_per_pixel_;
};

}  // namespace raytrace
