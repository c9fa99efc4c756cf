// Overlaps and gaps of random layouts, against counting every sample of every pixel.
#include "raytrace/batch/piece_layout.h"

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.h"

namespace raytrace::test {

namespace {

constexpr int side = 6;
constexpr int samples = 4;

class Layouts {
 public:
  int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }

  /// Cuts a box of pixels and samples into pieces that fit, at random.
  void cut(const PieceExtent& box, std::vector<PieceExtent>& pieces) {
    const Region& r = box.region;
    const int length = static_cast<int>(box.last_sample - box.first_sample);
    const int axis = below(4);
    const int size = axis == 0 ? r.width() : axis == 1 ? r.height() : axis == 2 ? length : 1;
    if (size < 2) {
      pieces.push_back(box);
      return;
    }
    const int first = 1 + below(size - 1);
    PieceExtent a = box, b = box;
    if (axis == 0) a.region.x1 = b.region.x0 = r.x0 + first;
    if (axis == 1) a.region.y1 = b.region.y0 = r.y0 + first;
    if (axis == 2) a.last_sample = b.first_sample = box.first_sample + static_cast<std::uint64_t>(first);
    cut(a, pieces);
    cut(b, pieces);
  }

  PieceExtent random_piece() {
    const int x = below(side), y = below(side), first = below(samples);
    return {"",
            {x, y, x + 1 + below(side - x), y + 1 + below(side - y)},
            static_cast<std::uint64_t>(first),
            static_cast<std::uint64_t>(first + 1 + below(samples - first))};
  }

 private:
  std::mt19937 random_{12};
};

bool covers(const PieceExtent& piece, int x, int y, std::uint64_t sample) {
  return x >= piece.region.x0 && x < piece.region.x1 && y >= piece.region.y0 && y < piece.region.y1 &&
         sample >= piece.first_sample && sample < piece.last_sample;
}

/// How many pieces hold each sample: the least and the most.
std::pair<int, int> least_and_most(const std::vector<PieceExtent>& pieces) {
  int least = 1 << 20, most = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (std::uint64_t sample = 0; sample < samples; ++sample) {
        int times = 0;
        for (const PieceExtent& piece : pieces) times += covers(piece, x, y, sample);
        least = std::min(least, times);
        most = std::max(most, times);
      }
  return {least, most};
}

}  // namespace

TEST_CASE("overlaps and gaps are found in random layouts, and nowhere else") {
  Layouts random;
  int overlapping = 0, gaping = 0, exact = 0;
  for (int i = 0; i < 4000; ++i) {
    std::vector<PieceExtent> pieces;
    if (i % 4 == 3) {
      for (int n = random.below(6); n >= 0; --n) pieces.push_back(random.random_piece());
    } else {
      random.cut({"", {0, 0, side, side}, 0, samples}, pieces);
      if (i % 4 == 1) pieces.erase(pieces.begin() + random.below(static_cast<int>(pieces.size())));
      if (i % 4 == 2) pieces.push_back(random.random_piece());
    }
    for (std::size_t n = pieces.size(); n > 1; --n)
      std::swap(pieces[n - 1], pieces[static_cast<std::size_t>(random.below(static_cast<int>(n)))]);
    const auto [least, most] = least_and_most(pieces);
    INFO("layout " << i);
    REQUIRE(overlaps(pieces).empty() == (most < 2));
    REQUIRE(missing_parts(pieces, {{0, 0, side, side}, samples}).empty() == (least > 0));
    overlapping += most > 1;
    gaping += least == 0;
    exact += least == 1 && most == 1;
  }
  CHECK(overlapping > 500);
  CHECK(gaping > 500);
  CHECK(exact > 500);
}

TEST_CASE("overlaps and gaps are reported by their files, pixels and samples") {
  const PieceExtent left{"left.exr", {0, 0, 4, 8}, 0, 10}, right{"right.exr", {4, 0, 8, 8}, 0, 6},
      again{"again.exr", {3, 7, 4, 9}, 9, 12};
  const std::vector<std::string> twice = overlaps({left, right, again});
  REQUIRE(twice.size() == 1);
  CHECK(twice[0].find("left.exr") != std::string::npos);
  CHECK(twice[0].find("again.exr") != std::string::npos);
  CHECK(overlaps({left, right}).empty());

  CHECK(missing_parts({left, right}, {{0, 0, 8, 8}, 6}).empty());
  const std::vector<std::string> missing = missing_parts({left, right}, {{0, 0, 8, 8}, 10});
  REQUIRE(missing.size() == 1);
  CHECK(missing[0].starts_with("no piece holds samples 6 to 9 of the pixels 4,0,8,8"));
}

TEST_CASE("what is missing is reported with the options that render it") {
  using Lines = std::vector<std::string>;
  const Region whole{-8, 0, 56, 48};
  const auto tile = [&](int index, int count, std::uint64_t first, std::uint64_t last) {
    return PieceExtent{"piece.exr", tile_of(whole, index, count), first, last, raytrace::Tile{index, count}};
  };
  const PieceExtent all{"all.exr", whole, 0, 3}, rest{"rest.exr", whole, 5, 9};
  CHECK(missing_parts({tile(0, 3, 0, 4), tile(1, 3, 0, 4)}, {whole, 4}) ==
        Lines{"tile 2/3 is missing: render it with --tile 2/3 -s 4"});
  CHECK(missing_parts({tile(1, 3, 0, 4)}, {whole, 4, false, "-8,0,56,48"}) ==
        Lines{"tile 0/3 is missing: render it with --tile 0/3 -s 4 --crop=-8,0,56,48",
              "tile 2/3 is missing: render it with --tile 2/3 -s 4 --crop=-8,0,56,48"});
  CHECK(missing_parts({tile(0, 2, 0, 1)}, {whole, 1}) ==
        Lines{"tile 1/2 is missing: render it with --tile 1/2 --sample-offset 0 -s 1"});
  CHECK(missing_parts({tile(0, 2, 0, 1)}, {whole, 1, true}) ==
        Lines{"tile 1/2 is missing: render it with --tile 1/2 -s 1"});
  CHECK(missing_parts({all, rest}, {whole, 9}) ==
        Lines{"samples 3 to 4 are missing: render them with --sample-offset 3 -s 2"});
  CHECK(missing_parts({all, rest}, {whole, 10}) ==
        Lines{"samples 3 to 4 are missing: render them with --sample-offset 3 -s 2",
              "sample 9 is missing: render it with --sample-offset 9 -s 1"});
  CHECK(missing_parts({tile(0, 2, 0, 6), tile(1, 2, 0, 2), tile(1, 2, 4, 6)}, {whole, 6}) ==
        Lines{"samples 2 to 3 of tile 1/2 are missing: render them with --tile 1/2 --sample-offset 2 -s 2"});
  // A half and a third leave a sixth that is no tile of either cut.
  const Lines mixed = missing_parts({tile(0, 2, 0, 1), tile(2, 3, 0, 1)}, {whole, 1, true});
  REQUIRE(!mixed.empty());
  CHECK(mixed[0].starts_with("no piece holds sample 0 of the pixels "));
  // Halves of which one is cut again: the quarter is enough.
  CHECK(missing_parts({tile(0, 2, 0, 1), tile(2, 4, 0, 1)}, {whole, 1, true}) ==
        Lines{"tile 3/4 is missing: render it with --tile 3/4 -s 1"});
}

TEST_CASE("a picture of which much is missing is reported in a few lines") {
  std::vector<PieceExtent> pieces;
  for (int i = 0; i < 1000; ++i) pieces.push_back({"p", {2 * i, 0, 2 * i + 1, 1}, 0, 1});
  const std::size_t lines = missing_parts(pieces, {{0, 0, 2000, 1}, 1}).size();
  CHECK(lines > 1);
  CHECK(lines < 50);
}

}  // namespace raytrace::test
