// Which samples a block of pixels still wants.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "raytrace/film/film.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// What a block's pixels want of their sequences: [first, last) of those that have the fewest samples. A render of
/// packets of another shape that was stopped here leaves some with more.
template <class Block>
struct SamplesLeft {
  std::uint32_t first, last;
  std::uint32_t all_from;  ///< from here on, all pixels want all
  UintN lane_first;        ///< each lane's own first

  SamplesLeft(const Film& film, const Block& block, const Region& region, std::uint32_t samples) {
    const std::uint32_t begin = film.settings().samples.first;
    std::uint32_t least = 0, most = 0;
    if (film.content() == FilmContent::sums) {
      least = samples;
      block.for_each_pixel(region, [&](int x, int y, std::size_t) {
        const std::uint32_t before = film.sum(x, y).samples;
        least = std::min(least, before);
        most = std::max(most, before);
      });
    }
    first = begin + least;
    all_from = begin + most;
    last = begin + samples;
    lane_first = UintN(first);
    if (least == most) return;
    alignas(64) std::array<std::uint32_t, packet_lanes> firsts{};
    block.for_each_lane(region, [&](int x, int y, std::size_t lane) { firsts[lane] = begin + film.sum(x, y).samples; });
    lane_first = UintN::load_aligned(firsts.data());
  }
};

}  // namespace raytrace
