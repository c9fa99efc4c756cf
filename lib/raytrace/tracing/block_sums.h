// The sums of a block's samples, on their way from the integrator to the film.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "raytrace/film/film_means.h"
#include "raytrace/film/radiance_layer.h"
#include "raytrace/math/fixed_point_sums.h"
#include "raytrace/math/lanes.h"
#include "raytrace/math/limbs.h"
#include "raytrace/tracing/lane_counts.h"
#include "raytrace/tracing/ray_result.h"

namespace raytrace {

/// What all sums of a film have in common.
struct SumScale {
  double inverse_unit;  ///< one over the film's unit
  float most_at_once;   ///< the largest radiance, either sign, that FixedPointSums take
  float most;           ///< that can be added

  /// unit_exponent: the film's.
  explicit SumScale(int unit_exponent)
      : inverse_unit(std::ldexp(1.0, -unit_exponent)),
        most_at_once(in_units(FixedPointSums<FloatN>::largest_term, unit_exponent)),
        most(in_units(largest_units, unit_exponent)) {}

 private:
  static float in_units(double units, int unit_exponent) {
    return static_cast<float>(std::min(std::ldexp(units, unit_exponent), double{std::numeric_limits<float>::max()}));
  }
};

/// Those parts of the sums of so many pixels that are added one by one. They take memory only where there are any.
template <int pixels>
class LargeSums {
 public:
  using Channels = std::array<Int128, 3>;

  bool empty() const { return sums_ == nullptr; }
  /// Of the pixel.
  Channels& operator[](std::size_t pixel) {
    if (sums_ == nullptr) sums_ = std::make_unique<std::array<Channels, pixels>>();
    return (*sums_)[pixel];
  }
  const Channels& operator[](std::size_t pixel) const { return (*sums_)[pixel]; }

  /// Adds the radiance of these lanes, given as bits. The result: those of them of which a channel is beyond
  /// scale.most, or not a number; they add nothing.
  [[gnu::noinline, gnu::cold]] std::uint32_t add(const Rgb<FloatN>& radiance, std::uint32_t lanes,
                                                 const SumScale& scale) {
    std::uint32_t refused = 0;
    for (const std::size_t lane : SetLanes(lanes)) {
      const std::array<float, 3> terms{radiance.red.get(lane), radiance.green.get(lane), radiance.blue.get(lane)};
      if (!std::all_of(terms.begin(), terms.end(), [&](float term) { return std::abs(term) <= scale.most; })) {
        refused |= std::uint32_t{1} << lane;
        continue;
      }
      Channels& sums = (*this)[lane % pixels];
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += whole_units(terms[i], scale.inverse_unit);
    }
    return refused;
  }

 private:
  std::unique_ptr<std::array<Channels, pixels>> sums_;
};

/// Of a PacketBlock's pixels, exact.
template <class Block>
class BlockSums {
 public:
  explicit BlockSums(const SumScale& scale) : scale_(scale) {}

  /// So many packets may be added between calls of carry().
  static constexpr int most_packets = 4096 / packet_lanes - 1;

  /// Adds a sample of each lane of `wanted`. The result: those whose radiance is still to be added, with add_large().
  RAYTRACE_INLINE MaskN add(const RayResult& result, const MaskN& wanted) {
    hits_.add(result.hit & wanted);
    samples_.add(wanted);
    return add_light(result.radiance, wanted);
  }
  /// The same without counting samples.
  RAYTRACE_INLINE MaskN add_light(const Rgb<FloatN>& light, const MaskN& wanted) {
    // The sum is large where one of them is, and NaN compares false.
    const MaskN fine = wanted & (abs(light.red) + abs(light.green) + abs(light.blue) <= FloatN(scale_.most_at_once));
    const Rgb<FloatN> radiance = select(fine, light, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
    red_.add(radiance.red, scale_.inverse_unit);
    green_.add(radiance.green, scale_.inverse_unit);
    blue_.add(radiance.blue, scale_.inverse_unit);
    return wanted & !fine;
  }

  /// The same for large radiances, of few lanes. The result: those whose radiance is not finite, or beyond what the
  /// sums can hold, which are counted as black.
  std::uint32_t add_large(const Rgb<FloatN>& radiance, const MaskN& lanes) {
    return large_.add(radiance, bits_of<FloatN>(lanes), scale_);
  }

  /// Makes room for most_packets more.
  void carry() {
    const auto red = red_.sums(), green = green_.sums(), blue = blue_.sums();
    for (std::size_t i = 0; i < red.size(); ++i) {
      auto& sums = large_[i];
      sums = {sums[0] + red[i], sums[1] + green[i], sums[2] + blue[i]};
    }
    red_ = green_ = blue_ = {};
  }

  /// Adds the radiance alone to those pixels of a layer.
  void add_to(RadianceLayer& layer, const Block& block, const Region& region) const {
    const auto red = red_.sums(), green = green_.sums(), blue = blue_.sums();
    block.for_each_pixel(region, [&](int x, int y, std::size_t i) {
      RadianceSum sum{red[i], green[i], blue[i]};
      if (!large_.empty())
        for (std::size_t channel = 0; channel < sum.size(); ++channel) sum[channel] += large_[i][channel];
      layer.add(x, y, sum);
    });
  }

  /// Adds them to the pixels of the block that lie in the region; to a film of means, they are all there is to come.
  RAYTRACE_INLINE void add_to(Film& film, const Block& block, const Region& region) const {
    const auto hits = hits_.by_pixel(), samples = samples_.by_pixel();
    if (!large_.empty()) [[unlikely]] {
      add_all_to(film, block, region);
    } else if (film.content() == FilmContent::sums) {
      const auto red = red_.sums(), green = green_.sums(), blue = blue_.sums();
      block.for_each_pixel(region, [&](int x, int y, std::size_t i) {
        film.add(x, y, {red[i], green[i], blue[i], hits[i], samples[i]});
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
  /// add_to() where some of the sums are in large_.
  [[gnu::noinline, gnu::cold]] void add_all_to(Film& film, const Block& block, const Region& region) const {
    const auto hits = hits_.by_pixel(), samples = samples_.by_pixel();
    const auto red = red_.sums(), green = green_.sums(), blue = blue_.sums();
    block.for_each_pixel(region, [&](int x, int y, std::size_t i) {
      const auto& large = large_[i];
      const Limbs r = limbs_of(large[0] + red[i]), g = limbs_of(large[1] + green[i]), b = limbs_of(large[2] + blue[i]);
      const PixelSum sum{r.low, g.low, b.low, hits[i], samples[i]};
      const PixelSumHigh high{r.high, g.high, b.high};
      if (film.content() == FilmContent::sums) {
        film.add(x, y, sum, high);
      } else {
        set_means(film, x, y, 1, [&](int) { return mean(sum, high, film.unit(), film.settings().transparent); });
      }
    });
  }

  SumScale scale_;
  FixedPointSums<FloatN, Block::pixels> red_, green_, blue_;
  LaneCounts<Block::pixels> hits_, samples_;
  LargeSums<Block::pixels> large_;
};

}  // namespace raytrace
