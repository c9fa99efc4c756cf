// Points of the unit disk.
#pragma once

#include "raytrace/math/simd.h"
#include "raytrace/math/turns.h"

namespace raytrace {

template <class T>
struct DiskPoint {
  T x, y;
};

/// Of (u1, u2) in the unit square: equal areas for equal areas, and what is close together stays so. Shirley and Chiu,
/// "A Low Distortion Map Between Disk and Square", 1997: squares about the middle become circles. T: a batch.
template <class T>
DiskPoint<T> on_unit_disk(const T& u1, const T& u2) {
  const T a = u1 * T(2) - T(1), b = u2 * T(2) - T(1);
  const auto wide = abs(a) > abs(b);
  const T radius = select(wide, a, b), other = select(wide, b, a);
  // Up to an eighth of a turn, from the right or from the top.
  const T divisor = select(radius == T(0), T(1), radius);
  const auto [sine, cosine] = sin_cos_of_turns(other / divisor * T(0.125F));
  return {radius * select(wide, cosine, sine), radius * select(wide, sine, cosine)};
}

}  // namespace raytrace
