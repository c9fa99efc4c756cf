// Tiles of pictures and crops of many sizes: nothing twice, nothing left out, nothing empty.
#include "raytrace/film/tiles.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "support/catch.h"

namespace raytrace::test {

namespace {

int pixels_of(const Region& region) { return region.width() * region.height(); }

std::string text_of(const Region& r, int count) {
  return std::to_string(count) + " of " + std::to_string(r.x0) + "," + std::to_string(r.y0) + "," +
         std::to_string(r.x1) + "," + std::to_string(r.y1);
}

std::vector<Region> tiles_of(const Region& region, int count) {
  std::vector<Region> tiles;
  for (int i = 0; i < count; ++i) tiles.push_back(tile_of(region, i, count));
  return tiles;
}

/// Checks that each pixel of the region is in one tile, and that each tile has one.
void check_cover(const Region& region, int count) {
  std::vector<int> times(static_cast<std::size_t>(pixels_of(region)));
  for (const Region& tile : tiles_of(region, count)) {
    const bool inside = tile.x0 >= region.x0 && tile.y0 >= region.y0 && tile.x1 <= region.x1 && tile.y1 <= region.y1;
    if (!inside || tile.width() < 1 || tile.height() < 1)
      FAIL("a tile is empty or outside: " << text_of(region, count));
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        ++times[static_cast<std::size_t>((y - region.y0) * region.width() + x - region.x0)];
  }
  if (std::any_of(times.begin(), times.end(), [](int n) { return n != 1; })) FAIL(text_of(region, count));
}

Region random_region(std::mt19937& random, int longest) {
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  const int x = below(100) - 50, y = below(100) - 50;  // below 0: beyond the picture
  return {x, y, x + 1 + below(longest), y + 1 + below(longest)};
}

}  // namespace

TEST_CASE("tiles cover small regions exactly, up to one tile a pixel") {
  for (const int width : {1, 2, 3, 5, 8, 9, 17})
    for (const int height : {1, 2, 4, 7, 8, 16})
      for (const int left : {0, 5})
        for (int count = 1; count <= width * height; ++count) check_cover({left, 3, left + width, 3 + height}, count);
  SUCCEED();
}

TEST_CASE("tiles cover random regions exactly") {
  std::mt19937 random(8);
  for (int i = 0; i < 300; ++i) {
    const Region region = random_region(random, 300);
    check_cover(region, 1 + static_cast<int>(random() % static_cast<unsigned>(std::min(pixels_of(region), 3000))));
  }
  for (const Region& strip : {Region{0, 0, 10000, 1}, Region{0, 7, 1, 10007}})
    for (const int count : {1, 2, 3, 999, 9999, 10000}) check_cover(strip, count);
  SUCCEED();
}

TEST_CASE("tiles of large regions are cut along blocks of 8 x 8 pixels of the picture") {
  std::mt19937 random(9);
  for (int i = 0; i < 200; ++i) {
    const Region region = random_region(random, 1000);
    const int blocks = (region.width() / 8) * (region.height() / 8);
    const int count = std::max(1, blocks / 32);
    if (blocks < 16 * count) continue;
    for (const Region& tile : tiles_of(region, count)) {
      const bool aligned = (tile.x0 % 8 == 0 || tile.x0 == region.x0) && (tile.y0 % 8 == 0 || tile.y0 == region.y0) &&
                           (tile.x1 % 8 == 0 || tile.x1 == region.x1) && (tile.y1 % 8 == 0 || tile.y1 == region.y1);
      if (!aligned) FAIL(text_of(region, count));
    }
  }
  SUCCEED();
}

TEST_CASE("the largest tile of a usual picture has at most twice the mean's pixels") {
  for (const Region& picture : {Region{0, 0, 640, 480}, Region{0, 0, 1920, 1080}, Region{0, 0, 1000, 1000},
                                Region{0, 0, 7680, 4320}, Region{0, 0, 16384, 16384}})
    for (const int count : {2, 3, 5, 7, 10, 16, 31, 64, 100, 257, 1000, 4096}) {
      int most = 0;
      for (const Region& tile : tiles_of(picture, count)) most = std::max(most, pixels_of(tile));
      if (most > 2.0 * pixels_of(picture) / count) FAIL(text_of(picture, count) << ": " << most << " pixels");
    }
  SUCCEED();
}

}  // namespace raytrace::test
