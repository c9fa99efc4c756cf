// From sums of samples to their means.
#pragma once

#include <bit>
#include <cstdint>

#include "raytrace/film/film.h"
#include "raytrace/math/compiler_vector.h"
#include "raytrace/math/inline.h"
#include "raytrace/math/limbs.h"

namespace raytrace {

/// Of so many samples, whose sums are given in units: black and empty if there are none. covered: the samples that
/// count for alpha. unit: Film::unit().
RAYTRACE_INLINE Pixel mean(double red, double green, double blue, std::uint32_t covered, std::uint32_t samples,
                           double unit) {
  if (samples == 0) return {};
  const CompilerVector<double, 4> totals{red, green, blue, static_cast<double>(covered)}, units{unit, unit, unit, 1};
  const auto quotients = samples == 1 ? totals : totals / static_cast<double>(samples);  // which takes long
  return std::bit_cast<Pixel>(__builtin_convertvector(quotients * units, CompilerVector<float, 4>));
}

/// Of the pixel's samples. transparent: FilmSettings::transparent.
inline Pixel mean(const PixelSum& sum, const PixelSumHigh& high, double unit, bool transparent) {
  const auto total = [](std::int64_t low, std::int64_t high_limb) {
    return high_limb == 0 ? static_cast<double>(low) : static_cast<double>(from_limbs({low, high_limb}));
  };
  return mean(total(sum.red, high.red), total(sum.green, high.green), total(sum.blue, high.blue),
              transparent ? sum.hits : sum.samples, sum.samples, unit);
}

}  // namespace raytrace
