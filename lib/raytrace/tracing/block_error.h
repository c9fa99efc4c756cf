// The error of a block's pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "raytrace/math/color.h"
#include "raytrace/math/simd.h"
#include "raytrace/tracing/error_estimate.h"

namespace raytrace {

/// Of each of a PacketBlock's pixels, the sums of the four quarters of its samples, in their order. Each quarter
/// is as well distributed as a full set of that many samples.
template <class Block>
class BlockError {
 public:
  /// Samples [first, last) of each pixel.
  BlockError(std::uint32_t first, std::uint32_t last) : first_(first), count_(last - first) {}

  /// The sample of that index of each lane of `wanted`.
  void add(const Rgb<FloatN>& radiance, const UintN& sample, const MaskN& wanted) {
    const FloatN value = (radiance.red + radiance.green + radiance.blue) / FloatN(3);
    const MaskN fine = wanted & (abs(value) <= FloatN(1e30F));  // NaN compares false
    for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
      const MaskN here = fine & from(sample, quarter);
      quarters_[quarter].add(value, quarter == 3 ? here : here & !from(sample, quarter + 1));
    }
  }

  /// Adds the pixels of the block that lie in the region and have two samples or more.
  void add_to(ErrorEstimate& estimate, const Block& block, const Region& region) const {
    block.for_each_pixel(region, [&](int, int, std::size_t pixel) {
      std::array<Sum, 4> quarters;
      for (std::size_t i = 0; i < quarters.size(); ++i) quarters[i] = quarters_[i].of(pixel);
      const Sum earlier = quarters[0] + quarters[1], later = quarters[2] + quarters[3], all = earlier + later;
      if (earlier.count == 0 || later.count == 0) return;
      const double by_halves = variance(earlier, later);
      const bool has_all = std::all_of(quarters.begin(), quarters.end(), [](const Sum& sum) { return sum.count > 0; });
      estimate.add(
          all.value / all.count, by_halves,
          has_all ? (variance(quarters[0], quarters[1]) + variance(quarters[2], quarters[3])) / 2 : 2 * by_halves);
    });
  }

 private:
  struct Sum {
    double value = 0, count = 0;
    Sum operator+(const Sum& other) const { return {value + other.value, count + other.count}; }
  };
  struct LaneSums {
    FloatN value{0.0F}, count{0.0F};

    void add(const FloatN& term, const MaskN& lanes) {
      value += select(lanes, term, FloatN(0));
      count += select(lanes, FloatN(1), FloatN(0));
    }
    Sum of(std::size_t pixel) const {
      Sum sum;
      for (std::size_t lane = pixel; lane < packet_lanes; lane += Block::pixels) {
        sum.value += double{value.get(lane)};
        sum.count += double{count.get(lane)};
      }
      return sum;
    }
  };

  /// Of the mean of two sums together, if they are independent.
  static double variance(const Sum& a, const Sum& b) {
    const double difference = a.value / a.count - b.value / b.count, count = a.count + b.count;
    return difference * difference * (a.count / count) * (b.count / count);
  }

  /// Samples in that quarter or a later one.
  MaskN from(const UintN& sample, std::uint32_t quarter) const {
    const auto begin = first_ + static_cast<std::uint32_t>(std::uint64_t{count_} * quarter / 4);
    return float_mask<FloatN>(same_bits<IntN>(sample - UintN(begin)) >= IntN(0));
  }

  std::uint32_t first_, count_;
  std::array<LaneSums, 4> quarters_{};
};

}  // namespace raytrace
