// Wavelengths of paths, and what the channels weigh of them.
#include "raytrace/sampling/wavelength.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

constexpr int wavelength_steps = 1 << 17;

/// visit(deviation, the three weights) for numbers spread evenly from 0 to 1.
template <class Visit>
void for_each_wavelength(const Visit& visit) {
  for (std::size_t first = 0; first < wavelength_steps; first += lanes) {
    const WavelengthSample sample = sample_wavelength(batch_of<FloatN>(
        [&](std::size_t lane) { return (static_cast<double>(first + lane) + 0.5) / wavelength_steps; }));
    for (std::size_t lane = 0; lane < lanes; ++lane)
      visit(double{sample.deviation.get(lane)},
            std::array{double{sample.weights.red.get(lane)}, double{sample.weights.green.get(lane)},
                       double{sample.weights.blue.get(lane)}});
  }
}

double deviation_of(double wavelength) { return 1 / (wavelength * wavelength) - 1 / (0.5876 * 0.5876); }

/// The share of a channel's hat above that deviation: below its wavelength.
double share_above(const WavelengthHat& hat, double deviation) {
  const double w = 1 / std::sqrt(deviation + 1 / (0.5876 * 0.5876));
  const double first{hat.first}, top{hat.top}, last{hat.last}, width = last - first;
  if (w <= first) return 0;
  if (w >= last) return 1;
  return w < top ? (w - first) * (w - first) / (width * (top - first))
                 : 1 - (last - w) * (last - w) / (width * (last - top));
}

}  // namespace

TEST_CASE("what channels weigh of the wavelengths is 1 in the mean, and 3 together at each") {
  std::array<double, 3> means{};
  double least = 3, most = 3;
  bool is_one_of_no_wavelength = false;
  for_each_wavelength([&](double deviation, const std::array<double, 3>& weights) {
    for (std::size_t i = 0; i < 3; ++i) means[i] += weights[i] / wavelength_steps;
    const double sum = weights[0] + weights[1] + weights[2];
    least = std::min(least, sum);
    most = std::max(most, sum);
    is_one_of_no_wavelength |= deviation == 0;
  });
  for (const double mean : means) CHECK(std::abs(mean - 1) < 1e-4);
  CHECK(std::abs(least - 3) < 1e-5);
  CHECK(std::abs(most - 3) < 1e-5);
  CHECK_FALSE(is_one_of_no_wavelength);
}

TEST_CASE("each channel has the wavelengths below its hat") {
  for (double wavelength = 0.41; wavelength < 0.68; wavelength += 0.01) {
    const double limit = deviation_of(wavelength);
    std::array<double, 3> above{};
    for_each_wavelength([&](double deviation, const std::array<double, 3>& weights) {
      for (std::size_t i = 0; i < 3; ++i) above[i] += deviation > limit ? weights[i] / wavelength_steps : 0;
    });
    for (std::size_t i = 0; i < 3; ++i) {
      INFO(wavelength << ", channel " << i);
      CHECK(std::abs(above[i] - share_above(wavelength_hats[i], limit)) < 2e-4);
    }
  }
}

TEST_CASE("the ends of random numbers have wavelengths, too") {
  for (const float u : {0.0F, 1.0F / 3, 2.0F / 3, std::nextafter(1.0F, 0.0F), std::nextafter(2.0F / 3, 0.0F)}) {
    const WavelengthSample sample = sample_wavelength(FloatN(u));
    const double w = 1 / std::sqrt(double{sample.deviation.get(0)} + 1 / (0.5876 * 0.5876));
    CHECK(w > shortest_wavelength - 1e-6);
    CHECK(w < longest_wavelength + 1e-6);
    const double sum =
        double{sample.weights.red.get(0)} + double{sample.weights.green.get(0)} + double{sample.weights.blue.get(0)};
    CHECK(std::abs(sum - 3) < 1e-5);
  }
}

TEST_CASE("Abbe's number is n_d - 1 over what lies between blue and red") {
  constexpr double ior = 1.7, abbe = 30;
  const auto index = [&](double wavelength) {
    return 1 + (ior - 1) * (1 + dispersion_of(abbe) * wavelength_deviation(wavelength));
  };
  CHECK(std::abs(index(0.5876) - ior) < 1e-7);
  CHECK(std::abs((ior - 1) / (index(0.4861) - index(0.6563)) - abbe) < 1e-4);
  CHECK(dispersion_of(0) == 0);
}

}  // namespace raytrace::test
