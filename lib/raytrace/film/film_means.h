// From sums of samples to their means: defined here, so that the wide code has the instructions for halves where there
// are any.
#pragma once

#include <half.h>

#include <array>
#include <bit>

#include "raytrace/film/film.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// Of the pixel's samples; black and empty if it has none. unit: Film::unit().
inline Pixel mean(const PixelSum& sum, double unit) {
  if (sum.samples == 0) return {};
  const CompilerVector<double, 4> totals{static_cast<double>(sum.red), static_cast<double>(sum.green),
                                         static_cast<double>(sum.blue), static_cast<double>(sum.hits)},
      units{unit, unit, unit, 1}, means = totals / static_cast<double>(sum.samples) * units;
  return std::bit_cast<Pixel>(__builtin_convertvector(means, CompilerVector<float, 4>));
}

inline HalfPixel in_halves(const Pixel& pixel) {
#if defined(RAYTRACE_CONVERTS_HALVES)
  return to_halves(std::bit_cast<std::array<float, 4>>(pixel));
#else
  return {imath_float_to_half(pixel.red), imath_float_to_half(pixel.green), imath_float_to_half(pixel.blue),
          imath_float_to_half(pixel.alpha)};
#endif
}

/// Gives a pixel of a film of either kind of means that of its samples.
inline void set_mean(Film& means, int x, int y, const PixelSum& sum) {
  const Pixel pixel = mean(sum, means.unit());
  if (means.content() == FilmContent::means) {
    means.float_mean(x, y) = pixel;
  } else {
    means.half_mean(x, y) = in_halves(pixel);
  }
}

}  // namespace raytrace
