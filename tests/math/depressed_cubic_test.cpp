// The cubic's roots against cubics that are made from roots.
#include "raytrace/math/depressed_cubic.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

struct Cubic {
  double p, q;

  /// Of the size of its terms, at a place.
  double error(double s) const {
    return std::abs(s * s * s + p * s + q) / (std::abs(s * s * s) + std::abs(p * s) + std::abs(q));
  }
};

using Lanes = std::array<double, lanes>;

std::array<Lanes, 3> roots_of(const std::array<Cubic, lanes>& cubics) {
  const auto p = batch_of<FloatN>([&](std::size_t i) { return cubics[i].p; }),
             q = batch_of<FloatN>([&](std::size_t i) { return cubics[i].q; });
  FloatN found[3];
  depressed_cubic_roots(p, q, found);
  std::array<Lanes, 3> roots;
  for (std::size_t root = 0; root < 3; ++root)
    for (std::size_t i = 0; i < lanes; ++i) roots[root][i] = static_cast<double>(found[root].get(i));
  return roots;
}

}  // namespace

TEST_CASE("a depressed cubic's three roots") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    std::array<Cubic, lanes> cubics;
    std::array<std::array<double, 3>, lanes> wanted;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double a = number(random), b = number(random), c = -(a + b);
      wanted[lane] = {a, b, c};
      std::ranges::sort(wanted[lane]);
      cubics[lane] = {a * b + a * c + b * c, -a * b * c};
    }
    const auto roots = roots_of(cubics);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto& [low, middle, high] = wanted[lane];
      if (std::min(middle - low, high - middle) < 0.05) continue;  // double ones have half the digits
      for (std::size_t root = 0; root < 3; ++root) {
        INFO("s^3 + " << cubics[lane].p << " s + " << cubics[lane].q << ", root " << root);
        REQUIRE(std::abs(roots[root][lane] - wanted[lane][root]) < 1e-4);
      }
    }
  }
}

TEST_CASE("a depressed cubic's only root stands in all three places") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> exponent(-6, 1), sign(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    std::array<Cubic, lanes> cubics;
    for (Cubic& cubic : cubics)
      cubic = {std::pow(10, exponent(random)), std::copysign(std::pow(10, exponent(random)), sign(random))};
    const auto roots = roots_of(cubics);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      INFO("s^3 + " << cubics[lane].p << " s + " << cubics[lane].q << ": " << roots[0][lane]);
      REQUIRE(roots[0][lane] == roots[1][lane]);
      REQUIRE(roots[1][lane] == roots[2][lane]);
      REQUIRE(cubics[lane].error(roots[0][lane]) < 1e-4);
    }
  }
}

TEST_CASE("a depressed cubic without linear or constant term") {
  const auto roots = roots_of([] {
    std::array<Cubic, lanes> cubics;
    cubics.fill({0, -8});
    cubics[1] = {-4, 0};
    cubics[2] = {0, 0};
    return cubics;
  }());
  CHECK(std::abs(roots[0][0] - 2) < 1e-4);
  CHECK(std::abs(roots[0][1] + 2) < 1e-4);
  CHECK(std::abs(roots[1][1]) < 1e-4);
  CHECK(std::abs(roots[2][1] - 2) < 1e-4);
  for (const auto& root : roots) CHECK(std::abs(root[2]) < 1e-4);
}

}  // namespace raytrace::test
