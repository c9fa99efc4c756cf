// The phase function of fog and of what is below surfaces, and distances along rays in fog: samples against densities.
#include "raytrace/bsdfs/henyey_greenstein.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "raytrace/tracing/fog_distances.h"
#include "support/catch.h"
#include "support/chi_square.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

constexpr int draws = 1 << 18, cells = 64;

/// How far samples are from a density on [first, last], in standard deviations; sample(u1, u2) and pdf(x) of batches.
template <class Sample, class Pdf>
double deviation(double first, double last, const Sample& sample, const Pdf& pdf) {
  std::mt19937 random(7);
  const auto numbers = [&] {
    return batch_of<FloatN>([&](std::size_t) { return static_cast<float>(random() >> 8U) * 0x1p-24F; });
  };
  std::vector<double> counts(cells), wanted(cells);
  for (int i = 0; i < draws; i += packet_lanes) {
    const FloatN u1 = numbers(), u2 = numbers(), x = sample(u1, u2);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double place = (static_cast<double>(x.get(lane)) - first) / (last - first) * cells;
      counts[static_cast<std::size_t>(std::min(std::max(place, 0.0), cells - 1.0))] += 1;
    }
  }
  constexpr int steps = 2000;
  for (int cell = 0; cell < cells; ++cell)
    for (int i = 0; i < steps; ++i) {
      const double x = first + (last - first) * (cell + (i + 0.5) / steps) / cells;
      wanted[static_cast<std::size_t>(cell)] +=
          static_cast<double>(pdf(FloatN(static_cast<float>(x))).get(0)) * (last - first) / cells / steps * draws;
    }
  return chi_square_deviation(counts, wanted);
}

}  // namespace

TEST_CASE("Henyey and Greenstein's samples follow their density, about any direction") {
  const float g = GENERATE(0.0F, 5e-4F, 0.3F, -0.5F, 0.9F, -0.98F);
  const Vec3d direction = GENERATE(Vec3d(0, 0, 1), Vec3d(0.48, -0.6, 0.64), Vec3d(0, -1, 0));
  double worst_length = 0;
  const double of_cosine = deviation(
      -1, 1,
      [&](const FloatN& u1, const FloatN& u2) {
        const Vec3<FloatN> wi = sample_henyey_greenstein(spread(direction), FloatN(g), u1, u2);
        worst_length = std::max(worst_length, std::abs(length(lane_of(wi, 0)) - 1));
        return dot(wi, spread(direction));
      },
      [&](const FloatN& cosine) { return henyey_greenstein(cosine, FloatN(g)) * FloatN(6.2831853F); });
  INFO("g " << g);
  CHECK(of_cosine < 4);
  CHECK(worst_length < 1e-6);
}

TEST_CASE("distances of free flights that end in a part follow their density, however thin the medium") {
  const float extinction = GENERATE(1e-12F, 1e-4F, 3e-4F, 0.1F, 2.0F, 30.0F);
  const FlightDistances flights{FloatN(extinction), FloatN(2), FloatN(5)};
  INFO("extinction " << extinction);
  CHECK(deviation(
            2, 5, [&](const FloatN& u, const FloatN&) { return flights.sample(u); },
            [&](const FloatN& x) { return flights.pdf(x); }) < 4);
  const double share = -std::expm1(-3 * static_cast<double>(extinction));
  CHECK(std::abs(static_cast<double>(flights.share().get(0)) / share - 1) < 1e-4);
}

TEST_CASE("equiangular distances follow their density, wherever the point is") {
  const Vec3d point = GENERATE(Vec3d(0.5, 0, 3), Vec3d(0.001, 0, 4), Vec3d(0, 0, 3), Vec3d(0, 2, -10),
                               Vec3d(300, 0, 900), Vec3d(1, 0, 5), Vec3d(0, 0, 7));
  const Ray<FloatN> ray{spread({0, 0, 0}), spread({0, 0, 1}), FloatN(0), FloatN(10)};
  const EquiangularDistances angles(ray, FloatN(2), FloatN(5), spread(point));
  INFO(point.x << " " << point.y << " " << point.z);
  double integral = 0;
  for (int i = 0; i < 3000000; ++i)
    integral += static_cast<double>(angles.pdf(FloatN(static_cast<float>(2 + (i + 0.5) * 1e-6))).get(0)) * 1e-6;
  CHECK(std::abs(integral - 1) < 0.005);
  if (point.x == 0.001 || (point.x == 0 && point.y == 0 && point.z < 5)) return;  // narrower than the cells
  CHECK(deviation(
            2, 5, [&](const FloatN& u, const FloatN&) { return angles.sample(u); },
            [&](const FloatN& x) { return angles.pdf(x); }) < 4);
}

}  // namespace raytrace::test
