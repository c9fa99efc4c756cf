// Sobol's (0,2)-sequence in two dimensions: where in a pixel its samples lie.
//
// Any 2^k consecutive points, beginning at a multiple of 2^k, have exactly one point in each of the 2^k boxes of any
// shape 2^a x 2^b (a + b = k) that the unit square divides into. So for every number of samples N, not only for powers
// of 2, no such box gets more than ceil(N / 2^k) or fewer than floor(N / 2^k) of them: stratified for every count, and
// a sample's place does not depend on how many will follow (renders can be cut into sample ranges, or go on later).
// Each pixel shifts the sequence by random digits of its own (exclusive or with a hash), which keeps those properties
// and makes every point uniformly distributed. Kollig and Keller, "Efficient Multidimensional Sampling", 2002;
// the order is that of the Gray code (Antonov and Saleev 1979), which makes the next point one exclusive or away.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace raytrace {

class SobolSequence {
 public:
  /// A point as binary fractions: x / 2^32, y / 2^32.
  struct Point {
    std::uint32_t x = 0, y = 0;
  };

  /// Stands at the point of the given index.
  explicit SobolSequence(std::uint32_t index = 0) : index_(index) {
    for (std::uint32_t bits = gray_code(index); bits != 0; bits &= bits - 1) flip(std::countr_zero(bits));
  }

  const Point& point() const { return point_; }

  /// On to the next index, at most 2^32 - 1.
  void advance() { flip(std::countr_zero(++index_)); }

  /// On by 2^step_bits, from an index that is a multiple of it.
  void advance(int step_bits) {
    const std::uint32_t before = index_;
    index_ += std::uint32_t{1} << step_bits;
    for (std::uint32_t bits = gray_code(before) ^ gray_code(index_); bits != 0; bits &= bits - 1)
      flip(std::countr_zero(bits));
  }

  /// Points are linear in the bits of their index: point(a ^ b) = point(a) ^ point(b). So this, with exclusive or,
  /// moves the points of indices that are multiples of 2^bits on by `number` < 2^bits, lane by lane.
  template <class Uints>
  static void offset_by(const Uints& number, int bits, Uints& x, Uints& y) {
    const Uints gray = number ^ (number >> 1);
    for (int bit = 0; bit < bits; ++bit) {
      const Uints has_bit = Uints(0u) - (gray >> bit & Uints(1u));
      x = x ^ (has_bit & Uints(0x80000000u >> bit));
      y = y ^ (has_bit & Uints(second_directions[static_cast<std::size_t>(bit)]));
    }
  }

 private:
  static std::uint32_t gray_code(std::uint32_t index) { return index ^ (index >> 1); }

  void flip(int bit) {
    point_.x ^= 0x80000000u >> bit;
    point_.y ^= second_directions[static_cast<std::size_t>(bit)];
  }

  /// Direction numbers of the second dimension: columns of Pascal's triangle modulo 2.
  static constexpr std::array<std::uint32_t, 32> second_directions = [] {
    std::array<std::uint32_t, 32> directions{};
    std::uint32_t direction = 0x80000000u;
    for (std::uint32_t& d : directions) {
      d = direction;
      direction ^= direction >> 1;
    }
    return directions;
  }();

  std::uint32_t index_;
  Point point_;
};

}  // namespace raytrace
