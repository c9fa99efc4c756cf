// Directions about an axis: what the BRDFs' sampling shares.
#pragma once

#include <numbers>

#include "raytrace/math/vec3.h"

namespace raytrace {

/// The unit vector at an angle of the given cosine and sine from `axis` (of unit length), turned about it by `turn`
/// full turns from a direction that depends on the axis alone. T: a batch.
template <class T>
Vec3<T> direction_about(const Vec3<T>& axis, const T& cosine, const T& sine, const T& turn) {
  // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017: good for every axis, the poles included.
  const T sign = select(axis.z < T(0), T(-1), T(1));
  const T a = T(-1) / (sign + axis.z);
  const T b = axis.x * axis.y * a;
  const Vec3<T> tangent{T(1) + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
  const Vec3<T> bitangent{b, sign + axis.y * axis.y * a, -axis.y};
  const auto [sine_of_turn, cosine_of_turn] = sincos(turn * T(2 * std::numbers::pi_v<float>));
  return tangent * (sine * cosine_of_turn) + bitangent * (sine * sine_of_turn) + axis * cosine;
}

}  // namespace raytrace
