// The stratification that sampling/sobol_sequence.h promises, by counting points in boxes.
#include "raytrace/sampling/sobol_sequence.h"

#include <algorithm>
#include <vector>

#include "raytrace/sampling/hash.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

constexpr int largest_k = 10;

/// The box of the point among the 2^a x 2^b into which the unit square divides.
std::size_t box_of(const SobolSequence::Point& point, int a, int b) {
  const auto column = a == 0 ? 0u : point.x >> (32 - a);
  const auto row = b == 0 ? 0u : point.y >> (32 - b);
  return (std::size_t{row} << a) + column;
}

/// `count` consecutive points from `first`, with their digits shifted by those of `shift`.
std::vector<SobolSequence::Point> points(std::uint32_t first, std::uint32_t count, SobolSequence::Point shift = {}) {
  SobolSequence sequence(first);
  std::vector<SobolSequence::Point> result;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i > 0) sequence.advance();  // not past the last, which may be the sequence's
    result.push_back({sequence.point().x ^ shift.x, sequence.point().y ^ shift.y});
  }
  return result;
}

}  // namespace

TEST_CASE("every aligned block of 2^k points has one in each box of 2^-k, whatever its shape") {
  // Digits of an index beyond the block's act as a shift of the block, so large indices are part of the statement.
  for (int k = 0; k <= largest_k; ++k) {
    const std::uint32_t size = 1u << k;
    for (const std::uint32_t block : {0u, 1u, 2u, 3u, 4u, 5u, 7u, 12u, 31u, 100u, 1023u, 123456u, 4194303u}) {
      const auto block_points = points(block * size, size);
      for (int a = 0; a <= k; ++a) {
        std::vector<int> count(size);
        for (const auto& point : block_points) ++count[box_of(point, a, k - a)];
        INFO("block " << block << " of 2^" << k << ", boxes of 2^-" << a << " x 2^-" << k - a);
        REQUIRE(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; }));
      }
    }
  }
}

TEST_CASE("the first N points fill the boxes of 2^-k evenly for every N, shifted or not") {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const SobolSequence::Point shift{seed * mix_bits(seed), seed * mix_bits(seed + 100)};  // seed 0: none
    const auto all = points(0, 1024, shift);
    for (int k = 0; k <= largest_k; ++k)
      for (int a = 0; a <= k; ++a) {
        std::vector<int> count(std::size_t{1} << k);
        for (int n = 1; n <= 1024; ++n) {
          ++count[box_of(all[static_cast<std::size_t>(n - 1)], a, k - a)];
          const auto [fewest, most] = std::minmax_element(count.begin(), count.end());
          const bool even = *fewest >= n >> k && *most <= (n + (1 << k) - 1) >> k;
          if (!even)
            FAIL("N " << n << ", boxes of 2^-" << a << " x 2^-" << k - a << ", shift " << shift.x << ", " << shift.y);
        }
      }
  }
  SUCCEED();
}

TEST_CASE("a sequence begun at an index stands where one that was advanced to it does") {
  SobolSequence advanced;
  for (std::uint32_t index = 0; index < 5000; ++index, advanced.advance()) {
    const SobolSequence direct(index);
    if (direct.point().x != advanced.point().x || direct.point().y != advanced.point().y) FAIL("index " << index);
  }
  // Up to the last index of all.
  SobolSequence late(0xfffffff0u);
  for (std::uint32_t index = 0xfffffff0u; index != 0xffffffffu; late.advance(), ++index)
    CHECK(SobolSequence(index).point().y == late.point().y);
  CHECK(SobolSequence(0xffffffffu).point().x == late.point().x);
  CHECK(SobolSequence(0xffffffffu).point().y == late.point().y);
}

TEST_CASE("a sequence advances by powers of 2 as it does by ones") {
  for (int bits = 0; bits <= 12; ++bits) {
    const std::uint32_t step = 1u << bits;
    for (const std::uint32_t first : {0u, 1u, 2u, 7u, 255u, 1000u}) {
      SobolSequence sequence(first * step);
      for (std::uint32_t i = first; i < first + 20; ++i, sequence.advance(bits)) {
        const SobolSequence::Point wanted = SobolSequence(i * step).point();
        if (sequence.point().x != wanted.x || sequence.point().y != wanted.y) FAIL("index " << i << " x 2^" << bits);
      }
    }
  }
  SUCCEED();
}

TEST_CASE("offset_by moves the first point of an aligned group to any other of it") {
  for (int bits = 0; bits <= 6; ++bits) {
    const std::uint32_t size = 1u << bits;
    for (const std::uint32_t group : {0u, 1u, 2u, 3u, 10u, 12345u, 0xffffffffu >> bits})
      for (std::uint32_t number = 0; number < size; ++number) {
        const SobolSequence::Point first = SobolSequence(group * size).point(),
                                   wanted = SobolSequence(group * size + number).point();
        std::uint32_t x = first.x, y = first.y;
        SobolSequence::offset_by(number, bits, x, y);
        if (x != wanted.x || y != wanted.y) FAIL("number " << number << " of group " << group << " of 2^" << bits);
      }
  }
  SUCCEED();
}

}  // namespace raytrace::test
