// How many samples of which pixels: the lanes of masks, counted.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "raytrace/math/simd.h"

namespace raytrace {

/// Of a PacketBlock of so many pixels: lane i belongs to pixel i % pixels.
template <int pixels>
class LaneCounts {
 public:
  /// Counts the lanes of the mask.
  RAYTRACE_INLINE void add(const MaskN& mask) {
    if constexpr (pixels == packet_lanes) {
      lanes_ = lanes_ + select_lanes(mask, IntN(1), IntN(0));
    } else {
      const std::uint32_t lanes = bits_of<FloatN>(mask);
      for (std::size_t i = 0; i < pixels; ++i)
        lanes_[i] += static_cast<std::uint32_t>(std::popcount(lanes & (lanes_of_first << i)));
    }
  }

  RAYTRACE_INLINE std::array<std::uint32_t, pixels> by_pixel() const {
    if constexpr (pixels == packet_lanes) {
      alignas(64) std::array<std::int32_t, pixels> counts;
      lanes_.store_aligned(counts.data());
      return std::bit_cast<std::array<std::uint32_t, pixels>>(counts);
    } else {
      return lanes_;
    }
  }

 private:
  static constexpr std::uint32_t lanes_of_first = [] {
    std::uint32_t lanes = 0;
    for (int lane = 0; lane < packet_lanes; lane += pixels) lanes |= std::uint32_t{1} << lane;
    return lanes;
  }();

  std::conditional_t<pixels == packet_lanes, IntN, std::array<std::uint32_t, pixels>> lanes_{};
};

}  // namespace raytrace
