// The rays of a spherical camera.
#pragma once

#include <cmath>
#include <numbers>

#include "raytrace/cameras/pixel_frame.h"
#include "raytrace/cameras/spherical_camera.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/turns.h"

namespace raytrace {

template <>
class Kernel<SphericalCamera> {
 public:
  Kernel(const SphericalCamera::Parameters& parameters, const ViewPlane& viewplane)
      : frame_(parameters.eye, ViewFrame(parameters.eye, parameters.lookat, parameters.up)),
        turns_right_(1.0 / viewplane.hres),
        turns_up_(0.5 / viewplane.vres) {}

  Vec3f origin() const { return frame_.vectors<float>().eye; }

  template <class F>
  Ray<F> generate(const F& x, const F& y) const {
    using Number = LaneNumber<F>;
    const auto& frame = frame_.vectors<F>();
    const auto longitude = sin_cos_of_turns(x * F(static_cast<Number>(turns_right_)));
    const auto latitude = sin_cos_of_turns(y * F(static_cast<Number>(turns_up_)));
    const Vec3<F> forward = Vec3<F>(frame.forward) * (latitude.cosine * longitude.cosine);
    const Vec3<F> across = frame.at_pixel(Vec3<Number>(0, 0, 0), latitude.cosine * longitude.sine, latitude.sine);
    return {Vec3<F>(frame.eye), normalize(forward + across), F(0), infinity<F>()};
  }

  std::optional<FilmPoint> project(const Vec3d& p) const {
    const auto& [eye, forward, right, up] = frame_.in_double();
    const Vec3d way = p - eye;
    const double distance2 = dot(way, way), distance = std::sqrt(distance2);
    if (!(distance > 0)) return std::nullopt;
    const double ahead = dot(way, forward), across = dot(way, right), sine = dot(way, up) / distance;
    const double turn = 2 * std::numbers::pi, cosine = std::hypot(ahead, across) / distance;
    if (!(cosine > 0)) return std::nullopt;
    return FilmPoint{std::atan2(across, ahead) / (turn * turns_right_), std::atan2(sine, cosine) / (turn * turns_up_),
                     eye, 1 / (distance2 * cosine * turn * turns_right_ * turn * turns_up_)};
  }

 private:
  PixelFrame frame_;
  double turns_right_, turns_up_;  ///< from pixel to pixel
};

}  // namespace raytrace
