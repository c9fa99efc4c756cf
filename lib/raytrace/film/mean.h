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
inline Pixel mean(const PixelSum& sum, double unit, bool transparent) {
  return mean(static_cast<double>(sum.red), static_cast<double>(sum.green), static_cast<double>(sum.blue),
              transparent ? sum.hits : sum.samples, sum.samples, unit);
}

/// Of sums with second limbs.
inline Pixel mean(const PixelSum& sum, const PixelSumHigh& high, double unit, bool transparent) {
  return mean(
      static_cast<double>(from_limbs({sum.red, high.red})), static_cast<double>(from_limbs({sum.green, high.green})),
      static_cast<double>(from_limbs({sum.blue, high.blue})), transparent ? sum.hits : sum.samples, sum.samples, unit);
}

}  // namespace raytrace
