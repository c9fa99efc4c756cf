// A picture cut into parts for several machines.
#pragma once

#include "raytrace/film/film.h"

namespace raytrace {

/// Part `index` of `count` of a region: together they cover it exactly, and none is empty. Where the region is large
/// enough, they are cut along the blocks of 8 x 8 pixels that packets share, and are as equal as that allows.
/// 0 <= index < count <= the region's pixels.
Region tile_of(const Region& region, int index, int count);

}  // namespace raytrace
