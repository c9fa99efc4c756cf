// The means that a film of means holds, as wide code sets them: with the instructions for halves where there are any.
#pragma once

#include <half.h>

#include <array>
#include <bit>
#include <cstdint>

#include "raytrace/film/mean.h"
#include "raytrace/math/simd.h"

namespace raytrace {

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
