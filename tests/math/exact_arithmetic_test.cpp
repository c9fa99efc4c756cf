// Arithmetic that must not lose a bit: exact_fma, and the difference with its rest.
#include <cmath>
#include <limits>
#include <random>

#include "raytrace/math/doubles.h"
#include "raytrace/shapes/sphere_kernel.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

class RandomFloats {
 public:
  /// Of 24 random digits and either sign, times 2^e with |e| <= exponents.
  float number(int exponents) {
    const float mantissa = static_cast<float>(bits_() >> 8 | 1u << 23);
    const int exponent = static_cast<int>(bits_() % static_cast<unsigned>(2 * exponents + 1)) - exponents;
    return std::ldexp((bits_() & 1) != 0 ? mantissa : -mantissa, exponent);
  }

 private:
  std::mt19937 bits_{11};
};

using Values = std::array<float, lanes>;

FloatN batch(const Values& values) {
  return batch_of<FloatN>([&](std::size_t i) { return values[i]; });
}

}  // namespace

TEST_CASE("exact_fma is the fused operation where the sum cancels") {
  RandomFloats random;
  for (int i = 0; i < 20000; ++i) {
    Values a, b, c;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      a[lane] = random.number(10);
      b[lane] = random.number(10);
      // All but the last digits of the product, or some more of them.
      c[lane] = -a[lane] * b[lane];
      if (lane % 2 == 1) c[lane] += random.number(0) * 0x1p-24f * std::abs(c[lane]) * 0x1p-18f;
    }
    const FloatN got = exact_fma(batch(a), batch(b), batch(c));
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (got.get(lane) != std::fma(a[lane], b[lane], c[lane]))
        FAIL("fma(" << a[lane] << ", " << b[lane] << ", " << c[lane] << ")");
  }
  SUCCEED();
}

TEST_CASE("exact_fma is within the last bit of the fused operation for any numbers, and nearly always that") {
  RandomFloats random;
  int differing = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    Values a, b, c;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      a[lane] = random.number(10);
      b[lane] = random.number(10);
      c[lane] = random.number(40);
    }
    const FloatN got = exact_fma(batch(a), batch(b), batch(c));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const float wanted = std::fma(a[lane], b[lane], c[lane]);
      differing += got.get(lane) != wanted;
      if (std::abs(got.get(lane) - wanted) > std::abs(wanted) * 0x1p-23f)
        FAIL("fma(" << a[lane] << ", " << b[lane] << ", " << c[lane] << ")");
    }
  }
  CHECK(differing < count * packet_lanes / 10000);
}

TEST_CASE("exact_fma neither overflows in the product nor underflows where the fused operation does not") {
  const float largest = std::numeric_limits<float>::max();
  CHECK(exact_fma(FloatN(largest), FloatN(2), FloatN(-largest)).get(0) == largest);
  CHECK(exact_fma(FloatN(0x1p-100f), FloatN(0x1p-40f), FloatN(0x1p-120f)).get(0) == 0x1p-120f + 0x1p-140f);
}

TEST_CASE("exact_difference splits a difference into its rounded value and the rest, without loss") {
  RandomFloats random;
  for (int i = 0; i < 50000; ++i) {
    Values a, b;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      a[lane] = random.number(16);
      b[lane] = i % 3 == 0 ? a[lane] * (1 + random.number(8) * 0x1p-40f) : random.number(16);
    }
    if (i == 0) b = a;
    FloatN difference, error;
    detail::exact_difference(batch(a), batch(b), difference, error);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      // 24 digits at either end of 32 binary places: 56, which long double holds.
      const long double exact = static_cast<long double>(a[lane]) - static_cast<long double>(b[lane]);
      const long double sum =
          static_cast<long double>(difference.get(lane)) + static_cast<long double>(error.get(lane));
      if (difference.get(lane) != a[lane] - b[lane] || sum != exact) FAIL(a[lane] << " - " << b[lane]);
    }
  }
  SUCCEED();
}

}  // namespace raytrace::test
