// Directions about an axis: what the BRDFs' sampling shares.
#pragma once

#include "raytrace/math/frame.h"
#include "raytrace/math/turns.h"

namespace raytrace {

/// The unit vector at an angle of the given cosine and sine from `axis` (of unit length), turned about it by `turn`
/// full turns from a direction that depends on the axis alone. T: a batch.
template <class T>
Vec3<T> direction_about(const Vec3<T>& axis, const T& cosine, const T& sine, const T& turn) {
  const SineAndCosine<T> turned = sin_cos_of_turns(turn);
  return Frame<T>(axis).to_world({sine * turned.cosine, sine * turned.sine, cosine});
}

}  // namespace raytrace
