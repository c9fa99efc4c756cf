// The points of a sample's further dimensions.
#include "raytrace/sampling/sampler.h"

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "raytrace/sampling/pixel_sampler.h"
#include "support/catch.h"
#include "support/chi_square.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

ScrambledPoint<std::uint32_t> lens_point_of(std::uint32_t column, std::uint32_t index) {
  return scrambled_point(pixel_hash(column, std::uint32_t{7}, 3), index, Dimension::lens);
}

}  // namespace

TEST_CASE("bits are reversed") {
  for (int bit = 0; bit < 32; ++bit) CHECK(reversed_bits(std::uint32_t{1} << bit) == std::uint32_t{1} << (31 - bit));
  CHECK(reversed_bits(std::uint32_t{0xf0a1}) == 0x850f0000u);
}

TEST_CASE("each run of 2^k samples of a pixel has one in each of its boxes") {
  for (const std::uint32_t column : {0u, 1u, 77u, 4000u})
    for (int k = 0; k <= 8; ++k)
      for (const std::uint32_t run : {0u, 1u, 5u, 4096u}) {
        const std::uint32_t count = 1u << k;
        for (int a = 0; a <= k; ++a) {
          std::set<std::pair<std::uint64_t, std::uint64_t>> boxes;
          for (std::uint32_t i = 0; i < count; ++i) {
            const auto [x, y] = lens_point_of(column, run * count + i);
            boxes.emplace(std::uint64_t{x} << a >> 32, std::uint64_t{y} << (k - a) >> 32);
          }
          INFO("pixel " << column << ", run " << run << " of 2^" << k << ", boxes 2^" << a << " across");
          CHECK(boxes.size() == count);
        }
      }
}

TEST_CASE("a lane's point is that of its pixel and index alone") {
  const UintN pixel = batch_of<UintN>([](std::size_t i) { return i * 77777 + 5; });
  const UintN index = batch_of<UintN>([](std::size_t i) { return i * i; });
  const Sample2D sample = get_2d(pixel, index, Dimension::lens);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto [x, y] = scrambled_point(pixel.get(lane), index.get(lane), Dimension::lens);
    CHECK(sample.x.get(lane) == static_cast<float>(x >> 8) * 0x1p-24f);
    CHECK(sample.y.get(lane) == static_cast<float>(y >> 8) * 0x1p-24f);
  }
}

TEST_CASE("over pixels, each sample is uniform, and has nothing to do with its neighbours or its place in the pixel") {
  constexpr std::uint32_t pixels = 1u << 16;
  const auto box = [](std::uint32_t bits) { return std::size_t{bits >> 28}; };
  for (const std::uint32_t index : {0u, 1u, 2u, 63u}) {
    std::vector<double> square(256), next_pixel(256), next_sample(256), in_pixel_x(256), in_pixel_y(256);
    SobolSequence sequence(index);
    for (std::uint32_t column = 0; column < pixels; ++column) {
      const auto [x, y] = lens_point_of(column, index);
      ++square[box(x) * 16 + box(y)];
      if (column % 2 == 0) ++next_pixel[box(x) * 16 + box(lens_point_of(column + 1, index).x)];
      // Samples 2k and 2k + 1 lie in different halves: another pair.
      ++next_sample[box(x) * 16 + box(lens_point_of(column, index + 1024).y)];
      const PixelScramble<std::uint32_t> shift(column, std::uint32_t{7}, 3);
      ++in_pixel_x[box(x) * 16 + box(sequence.point().x ^ shift.x)];
      ++in_pixel_y[box(y) * 16 + box(sequence.point().y ^ shift.y)];
    }
    INFO("sample " << index);
    for (const auto* counts : {&square, &next_pixel, &next_sample, &in_pixel_x, &in_pixel_y})
      CHECK(std::abs(chi_square_deviation(*counts)) < 4);
  }
}

TEST_CASE("a smooth mean over a pixel's place and its lens together converges faster than at random") {
  // Of cos(x + u) cos(y + v) about its integral, over the samples of 256 pixels. At random: 0.252 / sqrt(256).
  constexpr std::uint32_t samples = 256;
  double sum_of_squares = 0;
  const double wanted = std::pow(2 * std::cos(1.0) - std::cos(2.0) - 1, 2);
  const auto fraction = [](std::uint32_t bits) { return static_cast<double>(bits) * 0x1p-32; };
  for (std::uint32_t column = 0; column < 256; ++column) {
    const PixelScramble<std::uint32_t> shift(column, std::uint32_t{7}, 3);
    double sum = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
      const SobolSequence sequence(i);
      const auto [u, v] = lens_point_of(column, i);
      sum += std::cos(fraction(sequence.point().x ^ shift.x) + fraction(u)) *
             std::cos(fraction(sequence.point().y ^ shift.y) + fraction(v));
    }
    sum_of_squares += std::pow(sum / samples - wanted, 2);
  }
  CHECK(std::sqrt(sum_of_squares / 256) < 0.008);
}

}  // namespace raytrace::test
