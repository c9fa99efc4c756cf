// The rays of a fisheye camera.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

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

  std::optional<FilmPoint> project(const Vec3d& p) const {
    const auto& [eye, forward, right, up] = frame_.in_double();
    const Vec3d way = p - eye;
    const double distance2 = dot(way, way), x = dot(way, right), y = dot(way, up), across = std::hypot(x, y);
    const double turn = 2 * std::numbers::pi,
                 radius = std::atan2(across, dot(way, forward)) / (turn * turns_per_pixel_);
    if (!(distance2 > 0) || radius > radius_) return std::nullopt;
    if (!(across > 0)) return FilmPoint{0, 0, eye, 1 / (distance2 * std::pow(turn * turns_per_pixel_, 2))};
    // A ring of the picture, and the sphere's that it shows.
    const double area = radius / (turn * turns_per_pixel_ * across / std::sqrt(distance2));
    return FilmPoint{x / across * radius, y / across * radius, eye, area / distance2};
  }

 private:
  PixelFrame frame_;
  double radius_;  ///< of the circle, in pixels
  double turns_per_pixel_;
};

}  // namespace raytrace
