// A grid as OpenVDB keeps it: tiles of 8 x 8 x 8 numbers where there are any.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/import/density_grid.h"
#include "raytrace/import/grid_limits.h"

namespace raytrace {

struct GridTiles {
  static constexpr int tile_edge = 8, tile_numbers = tile_edge * tile_edge * tile_edge;

  std::array<std::int64_t, 3> first{}, last{};        ///< the points that have numbers; all others have 0
  Affine world_from_index{};                          ///< of points by their indices
  std::array<std::int64_t, 3> first_tile{}, tiles{};  ///< indices of points over 8, and how many along each axis
  std::vector<std::int32_t> places{};                 ///< of each tile among all, x fastest; -1: it has zeros alone
  std::vector<float> numbers{};                       ///< tile by tile, x fastest
  std::uint64_t most_bytes = std::numeric_limits<std::uint64_t>::max();  ///< that they may take
  std::int32_t last_even = -1;  ///< the place of the last tile of one number; -1: none

  static std::int64_t tile_of(std::int64_t index) {
    return index >= 0 ? index / tile_edge : -((7 - index) / tile_edge);
  }
  /// The next tile, x fastest. Tiles of one number that follow each other are kept once. Throws GridError where all
  /// would take more than most_bytes.
  void add_tile(const std::array<float, tile_numbers>& tile) {
    const float first_number = tile.front();
    const bool is_even = std::all_of(tile.begin(), tile.end(), [&](float number) { return number == first_number; });
    if (is_even && first_number == 0) return places.push_back(-1);
    if (is_even && last_even >= 0 && numbers[static_cast<std::size_t>(last_even) * tile_numbers] == first_number)
      return places.push_back(last_even);
    if (numbers.size() == numbers.capacity()) {
      // Both are there while the numbers move.
      const std::size_t wanted = std::max<std::size_t>(numbers.size() * 2, std::size_t{tile_numbers} * 64);
      if (sizeof(float) * (numbers.size() + wanted) > most_bytes)
        throw GridError("its numbers take more than " + std::to_string(most_bytes >> 20U) +
                        " MiB, half of the memory that is free");
      numbers.reserve(wanted);
    }
    places.push_back(static_cast<std::int32_t>(numbers.size() / tile_numbers));
    if (is_even) last_even = places.back();
    numbers.insert(numbers.end(), tile.begin(), tile.end());
  }
  /// Finds first_tile and tiles. Throws GridError for more than DensityGrid has cells.
  void set_tiles() {
    std::int64_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (last[axis] < first[axis]) throw GridError("it has no points");
      first_tile[axis] = tile_of(first[axis]);
      tiles[axis] = tile_of(last[axis]) - first_tile[axis] + 1;
      if (tiles[axis] <= DensityGrid::most_cells) count *= tiles[axis];
      if (std::max<std::int64_t>(tiles[axis], count) > DensityGrid::most_cells)
        throw GridError(too_many_points({last[0] - first[0] + 1, last[1] - first[1] + 1, last[2] - first[2] + 1}));
    }
  }
};

/// Threads: so many at most share the work. Throws as DensityGrid does.
std::shared_ptr<const DensityGrid> grid_of_tiles(const GridTiles& tiles, int threads);

}  // namespace raytrace
