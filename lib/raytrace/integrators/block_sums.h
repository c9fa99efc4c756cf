// The sums of a block's samples, on their way from the integrator to the film.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "raytrace/film/film_means.h"
#include "raytrace/integrators/lane_counts.h"
#include "raytrace/integrators/ray_result.h"
#include "raytrace/math/fixed_point_sums.h"

namespace raytrace {

/// What all sums of a film have in common.
struct SumScale {
  double inverse_unit;  ///< one over the film's unit
  float most;           ///< the largest radiance that can be added

  /// unit_exponent: the film's.
  explicit SumScale(int unit_exponent)
      : inverse_unit(std::ldexp(1.0, -unit_exponent)),
        most(static_cast<float>(std::min(std::ldexp(FixedPointSums<FloatN>::largest_term, unit_exponent),
                                         double{std::numeric_limits<float>::max()}))) {}
};

/// Of a PacketBlock's pixels, exact.
template <class Block>
class BlockSums {
 public:
  explicit BlockSums(const SumScale& scale) : scale_(scale) {}

  /// Adds a sample of each lane of `wanted`. The result: those whose radiance is not finite (or beyond what the sums
  /// can hold), which are counted as black.
  RAYTRACE_INLINE MaskN add(const RayResult& result, const MaskN& wanted) {
    // Radiances are not negative: the sum is large where one of them is, and NaN compares false.
    const MaskN fine =
        wanted & (result.radiance.red + result.radiance.green + result.radiance.blue <= FloatN(scale_.most));
    const Rgb<FloatN> radiance = select(fine, result.radiance, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
    red_.add(radiance.red, scale_.inverse_unit);
    green_.add(radiance.green, scale_.inverse_unit);
    blue_.add(radiance.blue, scale_.inverse_unit);
    hits_.add(result.hit & wanted);
    samples_.add(wanted);
    return wanted & !fine;
  }

  /// Adds them to the pixels of the block that lie in the region; to a film of means, they are all there is to come.
  RAYTRACE_INLINE void add_to(Film& film, const Block& block, const Region& region) const {
    const auto hits = hits_.by_pixel(), samples = samples_.by_pixel();
    if (film.content() == FilmContent::sums) {
      const auto red = red_.sums(), green = green_.sums(), blue = blue_.sums();
      block.for_each_pixel(region, [&](int x, int y, std::size_t i) {
        film.sum(x, y) += {red[i], green[i], blue[i], hits[i], samples[i]};
      });
    } else {
      const auto& covered = film.settings().transparent ? hits : samples;
      const auto red = red_.rounded_sums(), green = green_.rounded_sums(), blue = blue_.rounded_sums();
      block.for_each_row(region, [&](int x, int y, int first, int count) RAYTRACE_INLINE_LAMBDA {
        set_means(film, x, y, count, [&](int i) RAYTRACE_INLINE_LAMBDA {
          const std::size_t pixel = static_cast<std::size_t>(first) + static_cast<std::size_t>(i);
          return mean(red[pixel], green[pixel], blue[pixel], covered[pixel], samples[pixel], film.unit());
        });
      });
    }
  }

 private:
  SumScale scale_;
  FixedPointSums<FloatN, Block::pixels> red_, green_, blue_;
  LaneCounts<Block::pixels> hits_, samples_;
};

}  // namespace raytrace
