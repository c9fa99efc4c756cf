#include "raytrace/film/tiles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace raytrace {

namespace {

/// Blocks of pixels, at (x, y) to (x + width, y + height).
struct Blocks {
  std::int64_t x, y, width, height;
  std::int64_t count() const { return width * height; }
};

/// Bisects along the longer edge, each half with a share of the parts in proportion to its blocks.
Blocks part_of(Blocks blocks, std::int64_t index, std::int64_t count) {
  while (count > 1) {
    const bool across = blocks.width >= blocks.height;
    const std::int64_t length = across ? blocks.width : blocks.height, other = across ? blocks.height : blocks.width;
    std::int64_t first_count = count / 2;
    // Rounded; never nothing, for either side.
    std::int64_t first_length = std::clamp((length * first_count + count / 2) / count, std::int64_t{1}, length - 1);
    // Each side must have a block for each of its parts: with few blocks a part, the cut decides on the parts instead.
    if (first_length * other < first_count || (length - first_length) * other < count - first_count) {
      first_length = length / 2;
      first_count =
          std::clamp(count * first_length / length, std::max(std::int64_t{1}, count - (length - first_length) * other),
                     std::min(count - 1, first_length * other));
    }
    const bool first = index < first_count;
    if (across) {
      blocks.x += first ? 0 : first_length;
      blocks.width = first ? first_length : length - first_length;
    } else {
      blocks.y += first ? 0 : first_length;
      blocks.height = first ? first_length : length - first_length;
    }
    index -= first ? 0 : first_count;
    count = first ? first_count : count - first_count;
  }
  return blocks;
}

}  // namespace

Region tile_of(const Region& region, int index, int count) {
  // Fewer blocks than this a part would make parts of too different sizes.
  constexpr std::int64_t least_blocks = 16;
  for (const int edge : {8, 1}) {
    const int left = round_down(region.x0, edge), top = round_down(region.y0, edge);
    const Blocks all{left / edge, top / edge, (region.x1 - left + edge - 1) / edge,
                     (region.y1 - top + edge - 1) / edge};
    if (edge > 1 && all.count() < least_blocks * count) continue;
    const Blocks part = part_of(all, index, count);
    const auto pixels = [edge](std::int64_t block) { return static_cast<int>(block * edge); };
    return {std::max(pixels(part.x), region.x0), std::max(pixels(part.y), region.y0),
            std::min(pixels(part.x + part.width), region.x1), std::min(pixels(part.y + part.height), region.y1)};
  }
  return region;
}

}  // namespace raytrace
