// A grid as OpenVDB keeps it: tiles of 8 x 8 x 8 numbers where there are any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "raytrace/import/density_grid.h"

namespace raytrace {

struct GridTiles {
  static constexpr int tile_edge = 8, tile_numbers = tile_edge * tile_edge * tile_edge;

  std::array<std::int64_t, 3> first{}, last{};        ///< the points that have numbers; all others have 0
  Affine world_from_index{};                          ///< of points by their indices
  std::array<std::int64_t, 3> first_tile{}, tiles{};  ///< indices of points over 8, and how many along each axis
  std::vector<std::int32_t> places{};                 ///< of each tile among all, x fastest; -1: it has zeros alone
  std::vector<float> numbers{};                       ///< tile by tile, x fastest

  static std::int64_t tile_of(std::int64_t index) {
    return index >= 0 ? index / tile_edge : -((7 - index) / tile_edge);
  }
  /// Finds first_tile and tiles. Throws GridError for more than DensityGrid has cells.
  void set_tiles() {
    std::int64_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (last[axis] < first[axis]) throw GridError("it has no points");
      first_tile[axis] = tile_of(first[axis]);
      tiles[axis] = tile_of(last[axis]) - first_tile[axis] + 1;
      if (tiles[axis] > DensityGrid::most_cells || (count *= tiles[axis]) > DensityGrid::most_cells)
        throw GridError("it is too large: its points are spread over more than 2000 x 2000 x 2000");
    }
  }
};

/// Threads: so many at most share the work. Throws as DensityGrid does.
std::shared_ptr<const DensityGrid> grid_of_tiles(const GridTiles& tiles, int threads);

}  // namespace raytrace
