// The sums of a block's samples, on their way from the integrator to the film.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "raytrace/film/film_means.h"
#include "raytrace/integrators/raycast.h"
#include "raytrace/math/fixed_point_sums.h"

namespace raytrace {

/// Of the lanes of a PacketBlock, exact.
class BlockSums {
 public:
  /// What all sums of a film have in common.
  struct Scale {
    Doubles<FloatN> units;  ///< one over the unit
    FloatN most;            ///< the largest radiance that can be added

    /// unit_exponent: the film's.
    explicit Scale(int unit_exponent)
        : units(std::ldexp(1.0, -unit_exponent)),
          most(static_cast<float>(std::min(std::ldexp(FixedPointSums<FloatN>::largest_term, unit_exponent),
                                           static_cast<double>(std::numeric_limits<float>::max())))) {}
  };

  /// scale: must outlive it.
  explicit BlockSums(const Scale& scale) : scale_(scale) {}

  /// Adds a sample of each lane of `wanted`. The result: those whose radiance is not finite (or beyond what the sums
  /// can hold), which are counted as black.
  RAYTRACE_INLINE MaskN add(const SeenRadiance& seen, const MaskN& wanted) {
    // Radiances are not negative: the sum is large where one of them is, and NaN compares false.
    const MaskN fine = wanted & (seen.radiance.red + seen.radiance.green + seen.radiance.blue <= scale_.most);
    const Rgb<FloatN> radiance = select(fine, seen.radiance, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
    red_.add(radiance.red, scale_.units);
    green_.add(radiance.green, scale_.units);
    blue_.add(radiance.blue, scale_.units);
    hits_ = hits_ + select_lanes(seen.hit & wanted, IntN(1), IntN(0));
    samples_ = samples_ + select_lanes(wanted, IntN(1), IntN(0));
    return wanted & !fine;
  }

  /// Adds them to the pixels of the block that lie in the region; to a film of means, they are all there is to come.
  template <class Block>
  RAYTRACE_INLINE void add_to(Film& film, const Block& block, const Region& region) const {
    alignas(64) std::array<std::int32_t, packet_lanes> hit_lanes, sample_lanes;
    hits_.store_aligned(hit_lanes.data());
    samples_.store_aligned(sample_lanes.data());
    const auto hits = Block::sum_by_pixel(hit_lanes), samples = Block::sum_by_pixel(sample_lanes);
    const auto hits_of = [&](std::size_t pixel) { return static_cast<std::uint32_t>(hits[pixel]); };
    const auto samples_of = [&](std::size_t pixel) { return static_cast<std::uint32_t>(samples[pixel]); };
    if (film.content() == FilmContent::sums) {
      const auto red = red_.template sums_of_every<Block::pixels>(),
                 green = green_.template sums_of_every<Block::pixels>(),
                 blue = blue_.template sums_of_every<Block::pixels>();
      block.for_each_pixel(region, [&](int x, int y, std::size_t i) {
        film.sum(x, y) += {red[i], green[i], blue[i], hits_of(i), samples_of(i)};
      });
    } else {
      const auto red = red_.template rounded_sums_of_every<Block::pixels>(),
                 green = green_.template rounded_sums_of_every<Block::pixels>(),
                 blue = blue_.template rounded_sums_of_every<Block::pixels>();
      block.for_each_row(region, [&](int x, int y, int first, int count) RAYTRACE_INLINE_LAMBDA {
        set_means(film, x, y, count, [&](int i) RAYTRACE_INLINE_LAMBDA {
          const std::size_t pixel = static_cast<std::size_t>(first) + static_cast<std::size_t>(i);
          return mean(red[pixel], green[pixel], blue[pixel], hits_of(pixel), samples_of(pixel), film.unit());
        });
      });
    }
  }

 private:
  const Scale& scale_;
  FixedPointSums<FloatN> red_, green_, blue_;
  IntN hits_ = IntN(0), samples_ = IntN(0);
};

}  // namespace raytrace
