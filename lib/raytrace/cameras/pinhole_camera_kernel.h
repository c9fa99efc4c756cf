// The rays of a pinhole camera.
#pragma once

#include "raytrace/cameras/pinhole_camera.h"
#include "raytrace/cameras/pixel_frame.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

template <>
class Kernel<PinholeCamera> {
 public:
  Kernel(const PinholeCamera::Parameters& parameters, const ViewPlane& viewplane)
      : Kernel(parameters.eye, {parameters.eye, parameters.lookat, parameters.up},
               viewplane.pixelsize / parameters.viewdistance, shift_in_pixels(parameters, viewplane)) {}

  Vec3f origin() const { return frame_.vectors<float>().eye; }
  Vec2d axis() const { return {-shift_.x, -shift_.y}; }

  template <class F>
  RAYTRACE_INLINE Ray<F> generate(const F& x, const F& y) const {
    const auto& frame = frame_.vectors<F>();
    return {Vec3<F>(frame.eye), normalize(frame.at_pixel(frame.forward, x, y)), F(0), infinity<F>()};
  }

  std::optional<FilmPoint> project(const Vec3d& p) const {
    const auto& frame = frame_.in_double();
    const Vec3d forward = frame.forward - frame.right * shift_.x - frame.up * shift_.y;
    return project_on_plane(p, frame.eye, forward, frame.right, frame.up, shift_);
  }

 private:
  /// The view plane at distance 1, where pixels are so wide.
  Kernel(const Vec3d& eye, const ViewFrame& frame, double pixel, const Vec2d& shift)
      : frame_(eye, -(frame.w - frame.u * (pixel * shift.x) - frame.v * (pixel * shift.y)), frame.u * pixel,
               frame.v * pixel),
        shift_(shift) {}

  PixelFrame frame_;  ///< forward: to the picture's center
  Vec2d shift_;       ///< of that from the view's axis, in pixels
};

}  // namespace raytrace
