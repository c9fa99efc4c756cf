// Lanes of SIMD types in tests: filled one by one, and read back as doubles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raytrace/math/simd.h"

namespace raytrace::test {

inline constexpr std::size_t lanes = static_cast<std::size_t>(packet_lanes);

/// The batch whose lane i holds f(i).
template <class Batch, class Function>
Batch batch_of(Function f) {
  using Value = typename Batch::value_type;
  alignas(64) std::array<Value, Batch::size> values;
  for (std::size_t i = 0; i < Batch::size; ++i) values[i] = static_cast<Value>(f(i));
  return Batch::load_aligned(values.data());
}

/// f(i): a Vec3 of the lane.
template <class Function>
Vec3<FloatN> vectors_of(Function f) {
  return {batch_of<FloatN>([&](std::size_t i) { return f(i).x; }),
          batch_of<FloatN>([&](std::size_t i) { return f(i).y; }),
          batch_of<FloatN>([&](std::size_t i) { return f(i).z; })};
}

/// The same vector in every lane.
inline Vec3<FloatN> spread(const Vec3d& v) { return Vec3<FloatN>(Vec3f(v)); }

inline Vec3d lane_of(const Vec3<FloatN>& v, std::size_t lane) {
  return {static_cast<double>(v.x.get(lane)), static_cast<double>(v.y.get(lane)), static_cast<double>(v.z.get(lane))};
}

}  // namespace raytrace::test
