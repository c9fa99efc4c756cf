// The exact arithmetic of every instruction set that the library is built for, in registers of every width.
#include <cmath>
#include <random>

#include "support/catch.h"
#include "support/usable_isas.h"
#include "support/wide_arithmetic.h"

namespace raytrace::test {

namespace {

struct Case {
  WideLanes a, b, c;
};

/// Sums a * b + c of which little is left in every other lane.
Case cancelling_case(std::mt19937& bits) {
  const auto number = [&] {
    const float mantissa = static_cast<float>((bits() >> 8) | (1u << 23));
    return std::ldexp((bits() & 1) != 0 ? mantissa : -mantissa, static_cast<int>(bits() % 21) - 10);
  };
  Case result;
  for (std::size_t lane = 0; lane < result.a.size(); ++lane) {
    result.a[lane] = number();
    result.b[lane] = number();
    result.c[lane] = lane % 2 == 0 ? -(result.a[lane] * result.b[lane]) : number();
  }
  return result;
}

/// Checks `wanted` in each lane of many cases, by every instruction set and width.
template <class Wanted>
void check(WideArithmetic::Operation WideArithmetic::* operation, Wanted wanted) {
  for (const std::string& isa : usable_isas())
    for (const int lanes : {4, 8, 16}) {
      std::mt19937 bits(31);
      int wrong = 0;
      for (int i = 0; i < 2000; ++i) {
        const Case numbers = cancelling_case(bits);
        const WideLanes got = (wide_arithmetic(isa).*operation)(lanes, numbers.a, numbers.b, numbers.c);
        for (std::size_t lane = 0; lane < got.size(); ++lane)
          wrong += got[lane] != wanted(numbers.a[lane], numbers.b[lane], numbers.c[lane]);
      }
      INFO(isa << " in registers of " << lanes);
      CHECK(wrong == 0);
    }
}

}  // namespace

TEST_CASE("exact_fma rounds once with every instruction set") {
  check(&WideArithmetic::exact_fma, [](float a, float b, float c) { return std::fma(a, b, c); });
}

TEST_CASE("Doubles add a product and round with every instruction set") {
  check(&WideArithmetic::double_sum,
        [](float a, float b, float c) { return static_cast<float>(double{a} * double{b} + double{c}); });
}

TEST_CASE("comparisons of Doubles become masks of floats with every instruction set") {
  check(&WideArithmetic::below,
        [](float a, float b, float c) { return double{a} * double{b} < double{c} ? 1.0f : 0.0f; });
}

}  // namespace raytrace::test
