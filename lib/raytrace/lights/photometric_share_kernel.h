// What of a lamp's largest intensity goes into a direction.
#pragma once

#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

#include "raytrace/lights/photometry.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// Angles about the axis start at what is to its right where it points down, and run anticlockwise as seen from behind
/// the lamp, from above.
class PhotometricShare {
 public:
  /// axis: of unit length. Without photometry, all directions get all.
  PhotometricShare(const LoadedPhotometry& photometry, const Vec3f& axis)
      : photometry_(photometry.shares), axis_(axis), right_(right_of(-axis)), ahead_(cross(-axis, right_)) {}

  const Photometry* photometry() const { return photometry_.get(); }
  const Vec3f& axis() const { return axis_; }

  template <class F>
  F towards(const Vec3<F>& to_light) const {
    if constexpr (std::is_same_v<F, FloatN>)
      if (photometry_) [[unlikely]]
        return share(-to_light);
    return F(1);
  }

 private:
  /// Level and to the right where `up` points to the viewer.
  static Vec3f right_of(const Vec3f& up) {
    const float level = std::hypot(up.x, up.z);
    return level > 1e-6F ? Vec3f(up.z / level, 0, -up.x / level) : Vec3f(1, 0, 0);
  }

  FloatN share(const Vec3<FloatN>& direction) const {
    const FloatN x = dot(direction, Vec3<FloatN>(right_)), y = dot(direction, Vec3<FloatN>(ahead_));
    const auto steps = [](const FloatN& turns) { return turns * FloatN(720); };
    const auto lower = [](const FloatN& place, int last) { return min(max(to_int(place), IntN(0)), IntN(last)); };
    const FloatN row = steps(turns(sqrt(x * x + y * y), dot(direction, Vec3<FloatN>(axis_))));
    const IntN low = lower(row, Photometry::rows - 2);
    const auto mixed = [&](const IntN& first, const IntN& next, const FloatN& share) {
      const FloatN a = gather(photometry_->shares.data(), first), b = gather(photometry_->shares.data(), next);
      return a + (b - a) * share;
    };
    const FloatN up = row - to_float(low);
    if (photometry_->columns == 1) return mixed(low, low + IntN(1), up);
    const FloatN around = turns(y, x), column = steps(select(around < FloatN(0), around + FloatN(1), around));
    const IntN left = lower(column, Photometry::most_columns - 2);
    const IntN at = low * IntN(Photometry::most_columns) + left;
    const FloatN here = mixed(at, at + IntN(1), column - to_float(left));
    const IntN above = at + IntN(Photometry::most_columns);
    return here + (mixed(above, above + IntN(1), column - to_float(left)) - here) * up;
  }

  std::shared_ptr<const Photometry> photometry_;
  Vec3f axis_, right_, ahead_;
};

}  // namespace raytrace
