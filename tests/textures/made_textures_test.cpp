// Checkers and noise: their means over what a pixel covers.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "raytrace/textures/checker_kernel.h"
#include "raytrace/textures/noise_kernel.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

double unit(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-32; }

/// 1 and -1 in turn.
double wave(double x) { return static_cast<long>(std::floor(x)) % 2 == 0 ? 1 : -1; }

double mean_wave(double x, double width) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += wave(x + width * ((i + 0.5) / steps - 0.5));
  return sum / steps;
}

TexturePoint<FloatN> point_at(const std::array<Vec3d, lanes>& points, double width) {
  TexturePoint<FloatN> point{};
  point.world.p = vectors_of([&](std::size_t lane) { return points[lane]; });
  point.world.p_across = spread({width, 0, 0});
  point.world.p_along = spread({0, width, 0});
  point.uv = {point.world.p.x, point.world.p.y};
  point.uv_across = {FloatN(static_cast<float>(width)), FloatN(0)};
  point.uv_along = {FloatN(0), FloatN(static_cast<float>(width))};
  return point;
}

std::array<Vec3d, lanes> random_points(std::mt19937& random, double reach) {
  std::array<Vec3d, lanes> points;
  for (Vec3d& p : points)
    p = {reach * (2 * unit(random) - 1), reach * (2 * unit(random) - 1), reach * (2 * unit(random) - 1)};
  return points;
}

}  // namespace

TEST_CASE("a square wave's mean is its integral") {
  std::mt19937 random(2);
  double worst = 0;
  for (int i = 0; i < 40; ++i) {
    const double x = 8 * unit(random) - 4, width = i < 20 ? unit(random) : 6 * unit(random);
    const FloatN found = mean_square_wave(FloatN(static_cast<float>(x)), FloatN(static_cast<float>(width)));
    worst = std::max(worst, std::abs(static_cast<double>(found.get(0)) - mean_wave(x, width)));
  }
  CHECK(worst < 3e-4);  // of the sum that stands for the integral
}

TEST_CASE("a checker has its first colour from (0, 0) to (1, 1) and its second beside it, in space as on a surface") {
  std::mt19937 random(3);
  Checker::Parameters on_surface{{1, 0.5, 0.25}, {0, 0.25, 0.75}, {2, 3}, 0};
  Checker::Parameters in_space{on_surface.color1, on_surface.color2, {1, 1}, 0.5};
  int wrong = 0;
  for (int i = 0; i < 100; ++i) {
    const auto points = random_points(random, 5);
    const Rgba<FloatN> squares = Kernel<Checker>(on_surface).at(point_at(points, 0));
    const Rgba<FloatN> cubes = Kernel<Checker>(in_space).at(point_at(points, 0));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Vec3d p{Vec3f(points[lane])};
      const auto blue = [](double sign) { return sign > 0 ? 0.25F : 0.75F; };
      wrong += squares.color.blue.get(lane) != blue(wave(2 * p.x) * wave(3 * p.y));
      wrong += cubes.color.blue.get(lane) != blue(wave(2 * p.x) * wave(2 * p.y) * wave(2 * p.z));
    }
  }
  CHECK(wrong <= 2);  // where a float lies on an edge
}

TEST_CASE("a checker that a pixel covers many squares of is the mean of its colours") {
  std::mt19937 random(5);
  const Kernel<Checker> checker(Checker::Parameters{{1, 1, 1}, {0, 0, 0}, {1, 1}, 0});
  const Rgba<FloatN> found = checker.at(point_at(random_points(random, 50), 37.3));
  for (std::size_t lane = 0; lane < lanes; ++lane)
    CHECK(std::abs(static_cast<double>(found.color.red.get(lane)) - 0.5) < 1e-3);
}

TEST_CASE("noise stays between its colours, has no jumps, and its mean is halfway") {
  std::mt19937 random(7);
  const Kernel<Noise> noise(Noise::Parameters{{0, 1, 0}, {1, 0, 0}, 0.5, 5});
  double sum = 0, least = 1, most = 0, jump = 0;
  constexpr int packets = 2000;
  for (int i = 0; i < packets; ++i) {
    auto points = random_points(random, 100);
    const Rgba<FloatN> here = noise.at(point_at(points, 0));
    for (Vec3d& p : points) p = p + Vec3d(1e-4, 1e-4, 1e-4);
    const Rgba<FloatN> near = noise.at(point_at(points, 0));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double value = static_cast<double>(here.color.red.get(lane));
      sum += value / (packets * static_cast<double>(lanes));
      least = std::min(least, value);
      most = std::max(most, value);
      jump = std::max(jump, std::abs(value - static_cast<double>(near.color.red.get(lane))));
      CHECK_FALSE(std::abs(value + static_cast<double>(here.color.green.get(lane)) - 1) > 1e-6);
    }
  }
  CHECK(std::abs(sum - 0.5) < 0.01);
  CHECK(least >= 0);
  CHECK(most <= 1);
  CHECK(most - least > 0.6);
  CHECK(jump < 0.01);
}

TEST_CASE("noise that is finer than a pixel is gone, octave by octave") {
  std::mt19937 random(11);
  const auto deviation = [&](int octaves, double width) {
    const Kernel<Noise> noise(Noise::Parameters{{0, 0, 0}, {1, 1, 1}, 1, octaves});
    double sum = 0;
    for (int i = 0; i < 200; ++i) {
      const Rgba<FloatN> found = noise.at(point_at(random_points(random, 20), width));
      for (std::size_t lane = 0; lane < lanes; ++lane)
        sum += std::pow(static_cast<double>(found.color.red.get(lane)) - 0.5, 2);
    }
    return std::sqrt(sum / (200.0 * static_cast<double>(lanes)));
  };
  CHECK(deviation(1, 1) == 0);
  CHECK(deviation(1, 0.25) > 0.1);
  CHECK(deviation(8, 0.75) < 0.6 * deviation(8, 0));  // only half of the first is left
}

}  // namespace raytrace::test
