// Doubles<F> against scalar double arithmetic, lane by lane.
#include "raytrace/math/doubles.h"

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

using D = Doubles<FloatN>;
using Lanes = std::array<double, lanes>;

constexpr float float_infinity = std::numeric_limits<float>::infinity();

D load(const Lanes& values) {
  alignas(64) Lanes copy = values;
  return D::load_aligned(copy.data());
}

Lanes lanes_of(const D& doubles) { return std::bit_cast<Lanes>(doubles); }

/// Numbers of both signs over many magnitudes, now and then equal or zero.
class RandomDoubles {
 public:
  double number() {
    const auto kind = bits_() % 16;
    if (kind == 0) return 0;
    if (kind == 1) return 1;
    const double mantissa = static_cast<double>(bits_() | std::uint64_t{1}) * 0x1p-63 - 1;
    return std::ldexp(mantissa, static_cast<int>(bits_() % 80) - 40);
  }
  Lanes numbers() {
    Lanes result;
    for (double& value : result) value = number();
    return result;
  }

 private:
  std::mt19937_64 bits_{5};
};

/// Equal, or both NaN. The signs of zeros may differ: some instruction sets negate by subtracting from 0.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void check_binary(const std::function<D(const D&, const D&)>& wide,
                  const std::function<double(double, double)>& scalar) {
  RandomDoubles random;
  for (int i = 0; i < 2000; ++i) {
    const Lanes a = random.numbers(), b = random.numbers();
    const Lanes got = lanes_of(wide(load(a), load(b)));
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (!same(got[lane], scalar(a[lane], b[lane])))
        FAIL("lane " << lane << ": " << a[lane] << ", " << b[lane] << " gave " << got[lane] << ", not "
                     << scalar(a[lane], b[lane]));
  }
  SUCCEED();
}

void check_comparison(const std::function<Mask<D>(const D&, const D&)>& wide,
                      const std::function<bool(double, double)>& scalar) {
  RandomDoubles random;
  for (int i = 0; i < 2000; ++i) {
    const Lanes a = random.numbers(), b = random.numbers();
    const Mask<D> mask = wide(load(a), load(b));
    const Lanes chosen = lanes_of(select(mask, load(a), load(b)));
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const bool wanted = scalar(a[lane], b[lane]);
      bits |= static_cast<std::uint32_t>(wanted) << lane;
      if (!same(chosen[lane], wanted ? a[lane] : b[lane]))
        FAIL("select, lane " << lane << " of " << a[lane] << ", " << b[lane]);
    }
    if (bits_of<FloatN>(D::float_mask(mask)) != bits) FAIL("float_mask");
    if (any(mask) != (bits != 0)) FAIL("any");
  }
  SUCCEED();
}

}  // namespace

TEST_CASE("arithmetic of Doubles is double's") {
  SECTION("+") {
    check_binary([](const D& a, const D& b) { return a + b; }, [](double a, double b) { return a + b; });
  }
  SECTION("-") {
    check_binary([](const D& a, const D& b) { return a - b; }, [](double a, double b) { return a - b; });
  }
  SECTION("*") {
    check_binary([](const D& a, const D& b) { return a * b; }, [](double a, double b) { return a * b; });
  }
  SECTION("/") {
    check_binary([](const D& a, const D& b) { return a / b; }, [](double a, double b) { return a / b; });
  }
  SECTION("+=") {
    check_binary([](D a, const D& b) { return a += b; }, [](double a, double b) { return a + b; });
  }
  SECTION("sign") {
    check_binary([](const D& a, const D&) { return -a; }, [](double a, double) { return -a; });
  }
  SECTION("abs") {
    check_binary([](const D& a, const D&) { return abs(a); }, [](double a, double) { return std::abs(a); });
  }
  SECTION("sqrt") {
    check_binary([](const D& a, const D&) { return sqrt(a); }, [](double a, double) { return std::sqrt(a); });
  }
  SECTION("min") {
    check_binary([](const D& a, const D& b) { return min(a, b); }, [](double a, double b) { return b < a ? b : a; });
  }
  SECTION("max") {
    check_binary([](const D& a, const D& b) { return max(a, b); }, [](double a, double b) { return a < b ? b : a; });
  }
}

TEST_CASE("fma of Doubles is double's but for the last bits") {
  RandomDoubles random;
  for (int i = 0; i < 2000; ++i) {
    const Lanes a = random.numbers(), b = random.numbers(), c = random.numbers();
    const Lanes sums = lanes_of(multiply_add(load(a), load(b), load(c)));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      // Fused or not: off by no more than the rounding of the product.
      const double wanted = std::fma(a[lane], b[lane], c[lane]),
                   rounding = (std::abs(a[lane] * b[lane]) + std::abs(wanted)) * 0x1p-53;
      if (std::abs(sums[lane] - wanted) > 2 * rounding)
        FAIL("multiply_add(" << a[lane] << ", " << b[lane] << ", " << c[lane] << ")");
    }
  }
  SUCCEED();
}

TEST_CASE("comparisons of Doubles are double's, in masks of either width") {
  SECTION("<") {
    check_comparison([](const D& a, const D& b) { return a < b; }, std::less<>());
  }
  SECTION(">") {
    check_comparison([](const D& a, const D& b) { return a > b; }, std::greater<>());
  }
  SECTION("<=") {
    check_comparison([](const D& a, const D& b) { return a <= b; }, std::less_equal<>());
  }
  SECTION(">=") {
    check_comparison([](const D& a, const D& b) { return a >= b; }, std::greater_equal<>());
  }
  SECTION("&") {
    check_comparison([](const D& a, const D& b) { return (a < b) & (a > D(0.0)); },
                     [](double a, double b) { return a < b && a > 0; });
  }
  SECTION("|") {
    check_comparison([](const D& a, const D& b) { return (a < b) | (a > D(0.0)); },
                     [](double a, double b) { return a < b || a > 0; });
  }
}

TEST_CASE("a NaN compares false with everything") {
  const D nan(std::numeric_limits<double>::quiet_NaN());
  CHECK(!any(nan < D(1.0)));
  CHECK(!any(nan >= D(1.0)));
  CHECK(!any(D(1.0) <= nan));
}

TEST_CASE("floats become doubles without change, and their lanes keep their places") {
  const std::vector<float> values{0.0f,      -0.0f,           1.5f,
                                  -3e38f,    0x1.fffffep127f, 0x1p-126f,
                                  0x1p-149f, float_infinity,  -float_infinity,
                                  1.0f / 3,  123456792.0f,    std::numeric_limits<float>::quiet_NaN()};
  for (std::size_t first = 0; first < values.size(); ++first) {
    const auto value = [&](std::size_t lane) { return values[(first + lane) % values.size()]; };
    const D wide(batch_of<FloatN>(value));
    const FloatN back = wide.to_float();
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      CHECK(same(lanes_of(wide)[lane], static_cast<double>(value(lane))));
      CHECK(same(static_cast<double>(back.get(lane)), static_cast<double>(value(lane))));
    }
  }
}

TEST_CASE("doubles become the nearest float, and infinite beyond its range") {
  const std::vector<std::pair<double, float>> cases{
      {1e300, float_infinity},
      {-1e39, -float_infinity},
      {0x1.fffffefp127, 0x1.fffffep127f},  // just below the middle between the largest float and 2^128
      {0x1.ffffffp127, float_infinity},    // the middle
      {1e-300, 0.0f},
      {1.0 + 0x1p-24, 1.0f},  // a tie goes to the even one
      {1.0 + 3 * 0x1p-24, 1.0f + 0x1p-22f},
      {1.0 + 0x1.000001p-24, 1.0f + 0x1p-23f},
      {0.1, 0.1f},
      {0x1.8p-149, 0x1p-148f}};
  for (std::size_t first = 0; first < cases.size(); ++first) {
    Lanes values;
    for (std::size_t lane = 0; lane < lanes; ++lane) values[lane] = cases[(first + lane) % cases.size()].first;
    const FloatN rounded = load(values).to_float();
    for (std::size_t lane = 0; lane < lanes; ++lane)
      CHECK(rounded.get(lane) == cases[(first + lane) % cases.size()].second);
  }
}

}  // namespace raytrace::test
