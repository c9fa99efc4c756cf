// What each pixel gets of the sequence.
#include "raytrace/sampling/pixel_sampler.h"

#include <set>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "support/chi_square.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

UintN columns_from(std::uint32_t first) {
  return batch_of<UintN>([&](std::size_t i) { return first + i; });
}

PixelSampler sampler(std::uint32_t first_column, std::uint32_t row, std::uint64_t seed, int samples) {
  return {PixelScramble<UintN>(columns_from(first_column), UintN(row), seed), SampleGroup(UintN(0u), 1), 0,
          samples == 1};
}

using Place = std::pair<float, float>;

std::vector<Place> places(PixelSampler pixels, std::size_t lane, int count) {
  std::vector<Place> result;
  for (int i = 0; i < count; ++i) {
    const PixelSampler::Point point = pixels.next();
    result.emplace_back(point.x.get(lane), point.y.get(lane));
  }
  return result;
}

}  // namespace

TEST_CASE("a single sample is the pixel's center, whatever pixel and seed") {
  for (const std::uint64_t seed : {0ull, 7ull, ~0ull}) {
    const PixelSampler::Point point = sampler(1000, 17, seed, 1).next();
    CHECK(all(point.x == FloatN(0.5f)));
    CHECK(all(point.y == FloatN(0.5f)));
  }
}

TEST_CASE("samples lie from 0 up to 1") {
  auto some = sampler(5, 9, 3, 100), more = sampler(5, 9, 3, 4096);
  MaskN inside(true), same(true);
  for (int i = 0; i < 4096; ++i) {
    const PixelSampler::Point point = more.next();
    inside = inside & (point.x >= FloatN(0)) & (point.x < FloatN(1)) & (point.y >= FloatN(0)) & (point.y < FloatN(1));
    if (i >= 100) continue;
    const PixelSampler::Point again = some.next();
    same = same & (point.x == again.x) & (point.y == again.y);
  }
  CHECK(all(inside));
  CHECK(all(same));
}

TEST_CASE("a pixel's samples do not depend on the lane or the packet that it is in") {
  const auto wanted = places(sampler(20, 4, 11, 16), 0, 16);
  for (std::size_t lane = 0; lane < lanes; ++lane)
    CHECK(places(sampler(20 - static_cast<std::uint32_t>(lane), 4, 11, 16), lane, 16) == wanted);
}

TEST_CASE("other pixels and other seeds get other patterns") {
  std::set<std::vector<Place>> patterns;
  int count = 0;
  const auto add = [&](PixelSampler pixels, std::size_t lane) {
    patterns.insert(places(pixels, lane, 4));
    ++count;
  };
  for (std::uint32_t row = 0; row < 30; ++row)
    for (std::uint32_t column = 0; column < 30; ++column) add(sampler(column, row, 0, 4), 0);
  for (std::uint64_t seed = 1; seed < 100; ++seed) {
    add(sampler(0, 0, seed, 4), 0);
    add(sampler(0, 0, seed << 32, 4), 0);  // both halves of the seed count
  }
  CHECK(patterns.size() == static_cast<std::size_t>(count));
}

TEST_CASE("a pixel's samples have one in each of their boxes after the shift") {
  const auto pattern = places(sampler(77, 31, 5, 64), 0, 64);
  for (int a = 0; a <= 6; ++a) {
    std::set<std::pair<int, int>> boxes;
    for (const auto& [x, y] : pattern)
      boxes.emplace(static_cast<int>(x * static_cast<float>(1 << a)),
                    static_cast<int>(y * static_cast<float>(64 >> a)));
    CHECK(boxes.size() == 64);
  }
}

TEST_CASE("over the pixels of a picture, each sample is uniform over the unit square") {
  constexpr std::uint32_t edge = 256;
  constexpr int boxes = 32;
  for (const std::uint64_t seed : {0ull, 1ull, 0x123456789abcdefull}) {
    for (const int index : {0, 1, 6}) {
      std::vector<double> count(boxes * boxes), neighbours(boxes * boxes);
      for (std::uint32_t row = 0; row < edge; ++row)
        for (std::uint32_t column = 0; column < edge; column += static_cast<std::uint32_t>(lanes)) {
          auto pixels = sampler(column, row, seed, 16);
          PixelSampler::Point point = pixels.next();
          for (int i = 0; i < index; ++i) point = pixels.next();
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            const auto box = [&](const FloatN& v, std::size_t i) {
              return static_cast<std::size_t>(v.get(i) * float{boxes});
            };
            ++count[box(point.y, lane) * boxes + box(point.x, lane)];
            if (lane % 2 == 0) ++neighbours[box(point.x, lane) * boxes + box(point.x, lane + 1)];
          }
        }
      INFO("seed " << seed << ", sample " << index);
      CHECK(std::abs(chi_square_deviation(count)) < 4);
      CHECK(std::abs(chi_square_deviation(neighbours)) < 4);
    }
  }
}

TEST_CASE("lanes that share a pixel's samples have together those of one that has them all") {
  constexpr int count = 64;
  for (const std::uint32_t first : {0u, 32u, 992u}) {
    const auto wanted =
        places({PixelScramble(UintN(77u), UintN(31u), 5), SampleGroup(UintN(0u), 1), first, false}, 0, count);
    for (const int group : {1, 2, 4, 8, 16, 32}) {
      const UintN slot = batch_of<UintN>([&](std::size_t i) { return i % static_cast<std::size_t>(group); });
      // Told once, or lane by lane.
      const PixelSampler shared(PixelScrambles(5).at(77, 31), SampleGroup(slot, group), first, false),
          same(PixelScramble(UintN(77u), UintN(31u), 5), SampleGroup(slot, group), first, false);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto got = places(shared, lane, count / group);
        CHECK(got == places(same, lane, count / group));
        std::vector<Place> own;
        for (std::size_t i = lane % static_cast<std::size_t>(group); i < count; i += static_cast<std::size_t>(group))
          own.push_back(wanted[i]);
        INFO("lane " << lane << " in groups of " << group << " from " << first);
        CHECK(got == own);
      }
    }
  }
}

}  // namespace raytrace::test
