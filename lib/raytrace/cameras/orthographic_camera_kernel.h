// The rays of an orthographic camera.
#pragma once

#include "raytrace/cameras/orthographic_camera.h"
#include "raytrace/cameras/pixel_frame.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

template <>
class Kernel<OrthographicCamera> {
 public:
  Kernel(const OrthographicCamera::Parameters& parameters, const ViewPlane& viewplane)
      : Kernel(parameters.eye, {parameters.eye, parameters.lookat, parameters.up}, viewplane.pixelsize) {}

  template <class F>
  RAYTRACE_INLINE Ray<F> generate(const F& x, const F& y) const {
    const auto& frame = frame_.vectors<F>();
    return {frame.at_pixel(frame.eye, x, y), Vec3<F>(frame.forward), F(0), infinity<F>()};
  }

  std::optional<FilmPoint> project(const Vec3d& p) const {
    const auto& [eye, forward, right, up] = frame_.in_double();
    const Vec3d way = p - eye;
    if (!(dot(way, forward) > 0)) return std::nullopt;
    const double x = dot(way, right) / dot(right, right), y = dot(way, up) / dot(up, up);
    return FilmPoint{x, y, eye + right * x + up * y, 1 / (length(right) * length(up))};
  }

 private:
  Kernel(const Vec3d& eye, const ViewFrame& frame, double pixel)
      : frame_(eye, -frame.w, frame.u * pixel, frame.v * pixel) {}

  PixelFrame frame_;
};

}  // namespace raytrace
