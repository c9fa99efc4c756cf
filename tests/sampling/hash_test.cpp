// The hash that takes the place of random numbers.
#include "raytrace/sampling/hash.h"

#include <algorithm>
#include <vector>

#include "support/catch.h"
#include "support/chi_square.h"

namespace raytrace::test {

namespace {

constexpr std::uint32_t side = 256;  // pixels

template <class Function>
void for_each_pixel(Function f) {
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column) f(column, row);
}

}  // namespace

TEST_CASE("every byte of the hash is uniform over the pixels of a picture, as evenly as chance has it") {
  constexpr std::uint32_t seeds = 50;
  for (int byte = 0; byte < 4; ++byte) {
    // Over many seeds the deviations themselves must be a standard normal sample.
    double sum = 0, sum_of_squares = 0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      std::vector<double> count(256);
      for_each_pixel([&](std::uint32_t x, std::uint32_t y) { ++count[hash(x, y, seed, 0u) >> (8 * byte) & 255]; });
      const double deviation = chi_square_deviation(count);
      sum += deviation;
      sum_of_squares += deviation * deviation;
    }
    INFO("byte " << byte);
    CHECK(std::abs(sum / seeds) < 4 / std::sqrt(double{seeds}));
    CHECK(std::abs(sum_of_squares / seeds - 1) < 4 * std::sqrt(2.0 / seeds));
  }
}

TEST_CASE("the hashes of neighbouring pixels and of neighbouring seeds are independent") {
  const auto top_bits = [](std::uint32_t bits) { return std::size_t{bits >> 28}; };
  std::vector<double> right(256), below(256), next_seed(256), high_seed(256), mirrored(256);
  for_each_pixel([&](std::uint32_t x, std::uint32_t y) {
    const std::size_t first = top_bits(hash(x, y, 0u, 0u)) * 16;
    ++right[first + top_bits(hash(x + 1, y, 0u, 0u))];
    ++below[first + top_bits(hash(x, y + 1, 0u, 0u))];
    ++next_seed[first + top_bits(hash(x, y, 1u, 0u))];
    ++high_seed[first + top_bits(hash(x, y, 0u, 1u))];
    if (x < y) ++mirrored[first + top_bits(hash(y, x, 0u, 0u))];
  });
  CHECK(std::abs(chi_square_deviation(right)) < 4);
  CHECK(std::abs(chi_square_deviation(below)) < 4);
  CHECK(std::abs(chi_square_deviation(next_seed)) < 4);
  CHECK(std::abs(chi_square_deviation(high_seed)) < 4);
  CHECK(std::abs(chi_square_deviation(mirrored)) < 4);
}

TEST_CASE("no more pixels share a hash than chance brings together") {
  std::vector<std::uint32_t> hashes;
  for_each_pixel([&](std::uint32_t x, std::uint32_t y) {
    for (std::uint32_t seed = 0; seed < 16; ++seed) hashes.push_back(hash(x, y, seed, 0u));
  });
  std::sort(hashes.begin(), hashes.end());
  const auto distinct = std::unique(hashes.begin(), hashes.end()) - hashes.begin();
  const double n = static_cast<double>(hashes.size()), expected = n * n / 0x1p33;  // 128 of 2^20
  CHECK(std::abs(n - static_cast<double>(distinct) - expected) < 5 * std::sqrt(expected));
}

TEST_CASE("each bit of the input changes each bit of the mixed value half of the time") {
  constexpr int trials = 4096;
  for (int in = 0; in < 32; ++in) {
    std::vector<int> flips(32);
    for (std::uint32_t value = 0; value < trials; ++value) {
      const std::uint32_t changed = mix_bits(value * 0x9e3779b9u) ^ mix_bits((value * 0x9e3779b9u) ^ 1u << in);
      for (int out = 0; out < 32; ++out) flips[static_cast<std::size_t>(out)] += static_cast<int>(changed >> out & 1);
    }
    const auto [least, most] = std::minmax_element(flips.begin(), flips.end());
    INFO("input bit " << in);
    CHECK(*least > trials * 0.42);
    CHECK(*most < trials * 0.58);
  }
}

}  // namespace raytrace::test
