// The radiance of lights at a point.
#pragma once

#include <algorithm>
#include <limits>

#include "raytrace/lights/falloff.h"
#include "raytrace/lights/light_sample.h"
#include "raytrace/math/color.h"

namespace raytrace {

/// What of the radiance at distance 1 a point gets that the light is `to_light` away from: `largest` at most, so that
/// it is finite however near the light is.
template <class F, class G>
RAYTRACE_INLINE F inverse_square(const Vec3<F>& to_light, const G& largest) {
  using std::max, std::min;  // of plain numbers
  const F least(std::numeric_limits<float>::min());
  return min(F(1) / max(dot(to_light, to_light), least), F(largest));
}

class PointRadiance {
 public:
  PointRadiance(const Rgb<double>& radiance, Falloff falloff)
      : at_distance_1_(radiance), inverse_square_(falloff == Falloff::inverse_square) {
    const Rgb<float> size = abs(at_distance_1_);
    const float largest = std::max({size.red, size.green, size.blue, 1.0F});
    largest_share_ = std::numeric_limits<float>::max() / (largest * 2);  // no product with it leaves float's range
  }

  const Rgb<float>& at_distance_1() const { return at_distance_1_; }
  bool falls_off() const { return inverse_square_; }
  float largest_share() const { return largest_share_; }

  /// What a point gets that the light is `to_light` away from. Finite, however near it is.
  template <class F>
  RAYTRACE_INLINE Rgb<F> at(const Vec3<F>& to_light) const {
    return Rgb<F>(at_distance_1_) * (inverse_square_ ? inverse_square(to_light, largest_share_) : F(1));
  }

 private:
  Rgb<float> at_distance_1_;
  bool inverse_square_;
  float largest_share_;
};

}  // namespace raytrace
