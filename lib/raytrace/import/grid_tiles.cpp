#include "raytrace/import/grid_tiles.h"

namespace raytrace {

std::shared_ptr<const DensityGrid> grid_of_tiles(const GridTiles& tiles, int threads) {
  DensityGrid::Lattice lattice;
  // With the zeros around: there the density begins.
  const auto around = [](std::int64_t index) { return static_cast<double>(index - 1); };
  for (std::size_t axis = 0; axis < 3; ++axis) lattice.points[axis] = tiles.last[axis] - tiles.first[axis] + 3;
  lattice.added = 2;
  lattice.lower = Vec3d(0, 0, 0);
  lattice.upper = Vec3d(static_cast<double>(lattice.points[0] - 1), static_cast<double>(lattice.points[1] - 1),
                        static_cast<double>(lattice.points[2] - 1));
  const Affine to_index{.origin = Vec3d(around(tiles.first[0]), around(tiles.first[1]), around(tiles.first[2]))};
  lattice.world_from_lattice = tiles.world_from_index * to_index;
  return std::make_shared<const DensityGrid>(lattice, threads, [&](const std::array<int, 3>& first, float* to) {
    constexpr int points = DensityGrid::cell_points;
    // Of each of the nine along an axis: the tile, or -1, and the place in it.
    std::array<std::array<std::int64_t, points>, 3> tile{}, in_tile{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int i = 0; i < points; ++i) {
        const std::int64_t index = tiles.first[axis] - 1 + first[axis] + i;
        const bool is_there = index >= tiles.first[axis] && index <= tiles.last[axis];
        const std::int64_t number = GridTiles::tile_of(index);
        tile[axis][static_cast<std::size_t>(i)] = is_there ? number - tiles.first_tile[axis] : -1;
        in_tile[axis][static_cast<std::size_t>(i)] = index - number * GridTiles::tile_edge;
      }
    for (std::size_t z = 0; z < points; ++z)
      for (std::size_t y = 0; y < points; ++y)
        for (std::size_t x = 0; x < points; ++x, ++to) {
          *to = 0;
          if (tile[0][x] < 0 || tile[1][y] < 0 || tile[2][z] < 0) continue;
          const std::int32_t place = tiles.places[static_cast<std::size_t>(
              (tile[2][z] * tiles.tiles[1] + tile[1][y]) * tiles.tiles[0] + tile[0][x])];
          if (place < 0) continue;
          const std::int64_t in_brick = (in_tile[2][z] * 8 + in_tile[1][y]) * 8 + in_tile[0][x];
          *to = tiles.numbers[static_cast<std::size_t>(std::int64_t{place} * GridTiles::tile_numbers + in_brick)];
        }
  });
}

}  // namespace raytrace
