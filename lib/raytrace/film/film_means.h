// From sums of samples to their means: defined here, so that the wide code has the instructions for halves where there
// are any.
#pragma once

#include <half.h>

#include <bit>

#include "raytrace/film/film.h"

namespace raytrace {

/// Of the pixel's samples; black and empty if it has none. unit: Film::unit().
inline Pixel mean(const PixelSum& sum, double unit) {
  if (sum.samples == 0) return {};
  const double samples = sum.samples;
  if (std::has_single_bit(sum.samples)) {  // the same numbers, since the inverse is exact, and much sooner
    const double inverse = 1 / samples, scale = unit * inverse;
    const auto of = [&](std::int64_t total) { return static_cast<float>(static_cast<double>(total) * scale); };
    return {of(sum.red), of(sum.green), of(sum.blue), static_cast<float>(sum.hits * inverse)};
  }
  const auto of = [&](std::int64_t total) { return static_cast<float>(static_cast<double>(total) / samples * unit); };
  return {of(sum.red), of(sum.green), of(sum.blue), static_cast<float>(sum.hits / samples)};
}

/// Gives `means`, a film of either kind of them, those of a film of sums, whose region lies in its own.
inline void set_means(Film& means, const Film& sums) {
  const Region& part = sums.region();
  const double unit = sums.unit();
  const auto for_each_row = [&](const auto& f) {
    for (int y = part.y0; y < part.y1; ++y) f(y, &sums.sum(part.x0, y));
  };
  if (means.content() == FilmContent::means) {
    for_each_row([&](int y, const PixelSum* sum) {
      Pixel* pixel = means.means(part.x0, y);
      for (int x = part.x0; x < part.x1; ++x) *pixel++ = mean(*sum++, unit);
    });
  } else {
    for_each_row([&](int y, const PixelSum* sum) {
      HalfPixel* pixel = means.half_means(part.x0, y);
      for (int x = part.x0; x < part.x1; ++x) {
        const auto [red, green, blue, alpha] = mean(*sum++, unit);
        *pixel++ = {imath_float_to_half(red), imath_float_to_half(green), imath_float_to_half(blue),
                    imath_float_to_half(alpha)};
      }
    });
  }
}

}  // namespace raytrace
