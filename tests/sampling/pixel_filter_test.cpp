// Where filters place samples, against their shapes.
#include "raytrace/sampling/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "raytrace/sampling/pixel_sampler.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

constexpr PixelFilter all_filters[] = {PixelFilter::box, PixelFilter::triangle, PixelFilter::gaussian,
                                       PixelFilter::blackman_harris};

ViewPlane with_filter(PixelFilter filter, double width) {
  ViewPlane viewplane;
  viewplane.filter = filter;
  viewplane.filterwidth = width;
  return viewplane;
}

/// As the filter's name has it, `part` of its half width from the middle; of any scale.
double height(PixelFilter filter, double part) {
  const double t = std::numbers::pi * part;
  switch (filter) {
    case PixelFilter::triangle:
      return 1 - part;
    case PixelFilter::gaussian:
      return std::exp(-0.5 * std::pow(3 * part, 2));
    case PixelFilter::blackman_harris:
      return 0.35875 + 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) + 0.01168 * std::cos(3 * t);
    case PixelFilter::box:
      break;
  }
  return 1;
}

/// Where the filter puts (u, 0.5), along x.
double placed(const FilterTable& filter, double u) {
  return double{filtered(filter, {FloatN(static_cast<float>(u)), FloatN(0.5f)}).x.get(0)};
}

}  // namespace

TEST_CASE("samples are as dense as the filter is high") {
  for (const PixelFilter filter : all_filters) {
    const double width = 3;
    const FilterTable table(with_filter(filter, width));
    // The filter's integral up to each of so many places, and where the samples' own shares put it.
    constexpr int steps = 4000;
    std::vector<double> integral{0};
    for (int i = 0; i < steps; ++i) {
      const double part = std::abs((i + 0.5) / steps * 2 - 1);
      integral.push_back(integral.back() + height(filter, part));
    }
    double worst = 0;
    for (int i = 1; i < 2000; ++i) {
      const double u = i / 2000.0, place = (placed(table, u) - 0.5) / width + 0.5;
      const double share = integral[static_cast<std::size_t>(std::lround(place * steps))] / integral.back();
      worst = std::max(worst, std::abs(share - u));
    }
    INFO(Choices<PixelFilter>::words[static_cast<std::size_t>(filter)]);
    CHECK(worst < 5e-4);
  }
}

TEST_CASE("samples spread as far as the filter does") {
  for (const PixelFilter filter : all_filters) {
    const FilterTable table(with_filter(filter, 2));
    double all = 0, square = 0, fourth = 0;
    constexpr int steps = 100000;
    for (int i = 0; i < steps; ++i) {
      const double part = (i + 0.5) / steps, weight = height(filter, part);
      all += weight;
      square += weight * part * part;
      fourth += weight * std::pow(part, 4);
    }
    double own_square = 0, own_fourth = 0;  // of straight lines from one number to the next
    for (std::size_t i = 0; i < FilterTable::intervals; ++i) {
      const double a = table.distances()[i], b = table.distances()[i + 1];
      own_square += (a * a + a * b + b * b) / 3 / FilterTable::intervals;
      own_fourth += (a * a * a * a + a * b * (a * a + a * b + b * b) + b * b * b * b) / 5 / FilterTable::intervals;
    }
    INFO(Choices<PixelFilter>::words[static_cast<std::size_t>(filter)]);
    CHECK(own_square == Approx(square / all).epsilon(2e-4));
    CHECK(own_fourth == Approx(fourth / all).epsilon(1e-3));
  }
}

TEST_CASE("filters lie evenly about the centre, and leave it where it is") {
  for (const PixelFilter filter : all_filters) {
    const FilterTable table(with_filter(filter, 2.5));
    CHECK(table.moves_samples());
    CHECK(placed(table, 0.5) == 0.5);
    if (filter != PixelFilter::blackman_harris) CHECK(placed(table, 0) == Approx(0.5 - 1.25));
    CHECK(placed(table, 0) == Approx(0.5 - table.reach()));
    for (int i = 1; i < 64; ++i) CHECK(placed(table, 0.5 - i / 128.0) + placed(table, 0.5 + i / 128.0) == Approx(1));
    CHECK(placed(table, 1 - 0x1p-24) <= 0.5 + 1.25);
  }
}

TEST_CASE("a filter's width is its own where none is given") {
  CHECK_FALSE(FilterTable(with_filter(PixelFilter::box, 0)).moves_samples());
  CHECK_FALSE(FilterTable(with_filter(PixelFilter::box, 1)).moves_samples());
  CHECK(filter_width(with_filter(PixelFilter::triangle, 0)) == 2);
  CHECK(filter_width(with_filter(PixelFilter::gaussian, 0)) == 3);
  CHECK(filter_width(with_filter(PixelFilter::blackman_harris, 0)) == 3);
  CHECK(placed(FilterTable(with_filter(PixelFilter::gaussian, 0)), 0) == Approx(-1));
}

}  // namespace raytrace::test
