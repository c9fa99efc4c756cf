// Counter-based random numbers: a hash of what they are for, so that no state is carried from pixel to pixel.
#pragma once

#include <cstdint>

#include "raytrace/math/inline.h"

namespace raytrace {

/// Mixes the bits of `value` so that each depends on all (the lowbias32 constants of C. Wellons, "Prospecting for Hash
/// Functions", 2018). U: std::uint32_t or a batch of them.
template <class U>
RAYTRACE_INLINE U mix_bits(U value) {
  value = value ^ (value >> 16);
  value = value * U(0x7feb352du);
  value = value ^ (value >> 15);
  value = value * U(0x846ca68bu);
  return value ^ (value >> 16);
}

/// A hash of four words, uniform over all 32 bit numbers.
template <class U>
RAYTRACE_INLINE U hash(const U& a, const U& b, const U& c, const U& d) {
  return mix_bits(mix_bits(mix_bits(mix_bits(a) + b) + c) + d);
}

}  // namespace raytrace
