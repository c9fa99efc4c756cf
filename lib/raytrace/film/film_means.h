// From sums of samples to their means: defined here, so that the wide code has the instructions for halves where there
// are any.
#pragma once

#include <half.h>

#include <array>
#include <bit>
#include <cstdint>

#include "raytrace/film/film.h"
#include "raytrace/math/limbs.h"
#include "raytrace/math/simd.h"

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

inline HalfPixel in_halves(const Pixel& pixel) {
#if defined(RAYTRACE_CONVERTS_HALVES)
  return to_halves(std::bit_cast<std::array<float, 4>>(pixel));
#else
  return {imath_float_to_half(pixel.red), imath_float_to_half(pixel.green), imath_float_to_half(pixel.blue),
          imath_float_to_half(pixel.alpha)};
#endif
}

/// Gives a film of either kind of means those of `count` pixels beside each other, from (x, y) on to the right:
/// mean_of(0) and so on.
template <class MeanOf>
RAYTRACE_INLINE void set_means(Film& film, int x, int y, int count, const MeanOf& mean_of) {
  if (film.content() == FilmContent::means) {
    Pixel* const row = &film.float_mean(x, y);
    for (int i = 0; i < count; ++i) row[i] = mean_of(i);
  } else {
    HalfPixel* const row = &film.half_mean(x, y);
    for (int i = 0; i < count; ++i) row[i] = in_halves(mean_of(i));
  }
}

}  // namespace raytrace
