// A picture cut into parts for several machines.
#pragma once

#include "raytrace/film/region.h"

namespace raytrace {

/// Part `index` of `count`, as --tile asks for it.
struct Tile {
  int index = 0, count = 1;
  friend bool operator==(const Tile&, const Tile&) = default;
};

/// "2/8"
inline std::string text_of(const Tile& tile) { return std::to_string(tile.index) + "/" + std::to_string(tile.count); }

/// Part `index` of `count` of a region: together they cover it exactly, and none is empty. Where the region is large
/// enough, they are cut along the blocks of 8 x 8 pixels that packets share, and are as equal as that allows.
/// 0 <= index < count <= the region's pixels.
Region tile_of(const Region& region, int index, int count);

}  // namespace raytrace
