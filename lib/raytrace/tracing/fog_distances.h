// Distances along rays at which light in fog is looked for.
#pragma once

#include <numbers>

#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/turns.h"

namespace raytrace {

/// The share of light that an optical depth scatters or absorbs, and its inverse; both however small.
inline FloatN share_of_depth(const FloatN& depth) {
  return select(depth < FloatN(1e-3F), depth * (FloatN(1) - FloatN(0.5F) * depth), FloatN(1) - exp(-depth));
}
inline FloatN depth_of_share(const FloatN& share) {
  return select(share < FloatN(1e-3F), share * (FloatN(1) + FloatN(0.5F) * share), -log(FloatN(1) - share));
}

/// Distances of free flights that end in a part of rays' ways through a medium.
class FlightDistances {
 public:
  FlightDistances(const FloatN& extinction, const FloatN& begin, const FloatN& end)
      : extinction_(extinction),
        begin_(begin),
        end_(end),
        share_(max(share_of_depth(extinction * (end - begin)), FloatN(1e-30F))) {}
  /// u: in [0, 1).
  FloatN sample(const FloatN& u) const { return min(begin_ + depth_of_share(u * share_) / extinction_, end_); }
  /// Per unit of length, at distances in the part.
  FloatN pdf(const FloatN& distance) const { return extinction_ * exp(-extinction_ * (distance - begin_)) / share_; }
  /// The share of flights that end in the part, of all that come into it.
  const FloatN& share() const { return share_; }

 private:
  FloatN extinction_, begin_, end_, share_;
};

/// Distances from which angles to a point are spread evenly.
class EquiangularDistances {
 public:
  EquiangularDistances(const Ray<FloatN>& rays, const FloatN& begin, const FloatN& end, const Vec3<FloatN>& point)
      : begin_(begin), end_(end) {
    const Vec3<FloatN> way = point - rays.origin;
    nearest_ = dot(way, rays.direction);
    height_ = max(length(way - rays.direction * nearest_), length(way) * FloatN(1e-4F) + FloatN(1e-18F));
    const FloatN before = begin - nearest_, behind = end - nearest_;
    angle_ = max(atan2(height_ * (end - begin), height_ * height_ + before * behind), FloatN(1e-30F));
    first_slope_ = before / height_;
  }
  /// u: in [0, 1).
  FloatN sample(const FloatN& u) const {
    const SineAndCosine<FloatN> turned = sin_cos_of_turns(angle_ * u * FloatN(std::numbers::inv_pi_v<float> / 2));
    const FloatN way = height_ * turned.sine * (FloatN(1) + first_slope_ * first_slope_) /
                       max(turned.cosine - first_slope_ * turned.sine, FloatN(1e-30F));
    return min(max(begin_ + way, begin_), end_);
  }
  /// Per unit of length.
  FloatN pdf(const FloatN& distance) const {
    const FloatN along = distance - nearest_;
    return height_ / (angle_ * (height_ * height_ + along * along));
  }

 private:
  FloatN begin_, end_, nearest_, height_, angle_, first_slope_;
};

}  // namespace raytrace
