// Whole numbers beyond 64 bits, for exact sums of large terms.
#pragma once

#include <cmath>
#include <cstdint>

namespace raytrace {

/// Exact, and far from its ends here.
__extension__ typedef __int128 Int128;

/// A number as high * 2^64 + low. Both have a sign, so that high is 0 wherever 64 bits can hold the number.
struct Limbs {
  std::int64_t low = 0, high = 0;
};

constexpr Limbs limbs_of(Int128 number) {
  const auto low = static_cast<std::int64_t>(number);
  return {low, static_cast<std::int64_t>(number >> 64) + (low < 0 ? 1 : 0)};
}

constexpr Int128 from_limbs(const Limbs& limbs) { return Int128{limbs.high} * (Int128{1} << 64) + limbs.low; }

/// The most units that a term may stand for, either sign: 4 billion of them fit in both limbs.
inline constexpr double largest_units = 0x1p83;

/// A term of at most largest_units, rounded as FixedPointSums round it. inverse_unit: one over the unit, a power of
/// two.
inline Int128 whole_units(float term, double inverse_unit) {
  return static_cast<Int128>(std::nearbyint(double{term} * inverse_unit));
}

}  // namespace raytrace
