// The sky of a skylight: what must hold of any.
#include "raytrace/lights/sky_model.h"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "support/catch.h"

namespace raytrace::test {

namespace {

double luminance(const Rgb<double>& color) { return 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue; }

Vec3d towards(double degrees_up, double degrees_around) {
  const double up = degrees_up * std::numbers::pi / 180, around = degrees_around * std::numbers::pi / 180;
  return {std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around)};
}

}  // namespace

TEST_CASE("a clear sky's zenith is as bright as those that are measured") {
  // Thousands of candela per square metre (CIE S 011, Darula and Kittler: some 1 for a low sun to 5 for a high one).
  for (const auto& [height, least, most] : {std::array{15.0, 0.7, 1.5}, {40.0, 1.5, 3.0}, {65.0, 3.0, 7.0}}) {
    INFO(height);
    const double zenith = 40 * luminance(SkyModel({.sundirection = towards(height, 0)}, 1).sky({0, 1, 0}));
    CHECK(zenith > least);
    CHECK(zenith < most);
  }
}

TEST_CASE("the more haze, the paler the sky, and the weaker the sun") {
  Rgb<double> before{0, 0, 1};
  double sun_before = 1e9;
  for (const double turbidity : {1.0, 2.0, 4.0, 8.0}) {
    const SkyLight::Parameters parameters{.sundirection = towards(40, 0), .turbidity = turbidity};
    const Rgb<double> zenith = SkyModel(parameters, 1).sky({0, 1, 0}), sun = sun_irradiance(parameters);
    CHECK(zenith.red / zenith.blue > before.red / before.blue);
    CHECK(luminance(sun) < sun_before);
    before = zenith;
    sun_before = luminance(sun);
  }
}

TEST_CASE("a sky has no seams") {
  // Steps of a quarter of a degree, from the horizon to the zenith and around.
  const SkyModel model({.sundirection = towards(10, 30), .turbidity = 5}, 1);
  for (int i = 0; i < 359; ++i) {
    const double up = luminance(model.sky(towards(0.25 * i, 75))),
                 above = luminance(model.sky(towards(0.25 * i + 0.25, 75)));
    CHECK(std::abs(above / up - 1) < 0.06);
    const double here = luminance(model.sky(towards(5, i))), beside = luminance(model.sky(towards(5, i + 0.25)));
    CHECK(std::abs(beside / here - 1) < 0.06);
  }
}

TEST_CASE("the sky is blue, brightest about the sun, and alike on its two sides") {
  const SkyModel model({.sundirection = towards(35, 20), .turbidity = 2.5}, 1);
  const Rgb<double> zenith = model.sky({0, 1, 0});
  CHECK(zenith.blue > 1.5 * zenith.red);
  CHECK(luminance(model.sky(towards(35, 25))) > 3 * luminance(model.sky(towards(35, 200))));
  CHECK(model.sky(towards(20, 20 + 50)).green == Approx(model.sky(towards(20, 20 - 50)).green));
}

TEST_CASE("a lower sun is weaker and redder") {
  const Rgb<double> high = sun_irradiance({.sundirection = towards(80, 0)}),
                    low = sun_irradiance({.sundirection = towards(8, 0)});
  CHECK(luminance(low) < luminance(high) / 2);
  CHECK(low.blue / low.red < high.blue / high.red / 2);
}

TEST_CASE("the picture of a sky has the sun's side where it belongs, and below the horizon the ground that it lights") {
  SkyLight::Parameters parameters{.sundirection = towards(30, 90), .groundalbedo = {0.5, 0.5, 0.5}};  // at +z
  const Picture picture = SkyModel(parameters, 2).picture();
  const auto texel = [&](int column, int row) {
    float numbers[4] = {};
    std::memcpy(numbers,
                picture.pixels.data() + (static_cast<std::size_t>(row) * 1024 + static_cast<std::size_t>(column)) * 16,
                16);
    return Rgb<double>(double{numbers[0]}, double{numbers[1]}, double{numbers[2]});
  };
  REQUIRE(picture.width == 1024);
  CHECK(luminance(texel(512, 170)) > 2 * luminance(texel(0, 170)));
  CHECK(texel(100, 300).green == texel(900, 500).green);
  // With an albedo of 0.5 it sends on half of what arrives, the sun's part of which is known.
  const double of_sun = sun_irradiance(parameters).green * std::sin(std::numbers::pi / 6) * 0.5 / std::numbers::pi;
  CHECK(texel(100, 300).green > of_sun);
  CHECK(texel(100, 300).green < 2 * of_sun);
}

TEST_CASE("a skylight is as bright as its scaleradiance says") {
  const SkyLight::Parameters one{.sundirection = {1, 1, 1}}, three{.sundirection = {1, 1, 1}, .scaleradiance = 3};
  CHECK(SkyModel(three, 1).sky(towards(50, 10)).green == Approx(3 * SkyModel(one, 1).sky(towards(50, 10)).green));
  CHECK(sun_irradiance(three).green == Approx(3 * sun_irradiance(one).green));
}

TEST_CASE("a sky's bits do not depend on the number of threads") {
  const SkyLight::Parameters parameters{.sundirection = towards(25, 130)};
  const Picture one = SkyModel(parameters, 1).picture(), four = SkyModel(parameters, 4).picture();
  CHECK(std::memcmp(one.pixels.data(), four.pixels.data(), std::size_t{1024} * 512 * 16) == 0);
}

}  // namespace raytrace::test
