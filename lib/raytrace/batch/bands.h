// A picture whose film is too large for memory, rendered and written in bands of whole rows.
#pragma once

#include <algorithm>
#include <cstddef>

#include "raytrace/film/region.h"

namespace raytrace {

/// Films up to this size are held as a whole: of 67 million pixels, twice those of 8K, if nothing but colour is asked
/// for.
inline constexpr std::size_t largest_film = std::size_t{2} << 30U;
inline constexpr std::size_t largest_band = std::size_t{1} << 30U;

/// All of the region's, or of a band: the most whose film is not too large, and a multiple of every packet's height.
inline int rows_at_once(const Region& region, std::size_t pixel_bytes) {
  constexpr int unit = 32;
  const std::size_t row_bytes = pixel_bytes * static_cast<std::size_t>(region.width());
  if (row_bytes * static_cast<std::size_t>(region.height()) <= largest_film) return region.height();
  return unit * static_cast<int>(std::max<std::size_t>(1, largest_band / (unit * row_bytes)));
}

}  // namespace raytrace
