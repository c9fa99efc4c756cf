// The sky of a skylight: against the model's own numbers, and what must hold of any sky.
#include "raytrace/lights/sky_model.h"

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

TEST_CASE("the sky's zenith has the luminance of Preetham's formula") {
  for (const double turbidity : {2.0, 3.0, 6.0})
    for (const double height : {20.0, 45.0, 70.0}) {
      const double chi = (4.0 / 9 - turbidity / 120) * 2 * height * std::numbers::pi / 180;
      const double wanted = (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
      const SkyModel model({.sundirection = towards(height, 0), .turbidity = turbidity});
      INFO(turbidity << ", " << height);
      CHECK(luminance(model.sky({0, 1, 0})) == Approx(wanted / 40).epsilon(1e-3));
    }
}

TEST_CASE("the sky is blue, brightest about the sun, and alike on its two sides") {
  const SkyModel model({.sundirection = towards(35, 20), .turbidity = 2.5});
  const Rgb<double> zenith = model.sky({0, 1, 0});
  CHECK(zenith.blue > 1.5 * zenith.red);
  CHECK(luminance(model.sky(towards(35, 25))) > 3 * luminance(model.sky(towards(35, 200))));
  CHECK(model.sky(towards(20, 20 + 50)).green == Approx(model.sky(towards(20, 20 - 50)).green));
}

TEST_CASE("a lower sun is weaker and redder") {
  const Rgb<double> high = SkyModel({.sundirection = towards(80, 0)}).sun(),
                    low = SkyModel({.sundirection = towards(8, 0)}).sun();
  CHECK(luminance(low) < luminance(high) / 2);
  CHECK(low.blue / low.red < high.blue / high.red / 2);
}

TEST_CASE("the picture of a sky has the sun's side where it belongs, and below the horizon the ground that it lights") {
  SkyLight::Parameters parameters{.sundirection = towards(30, 90), .groundalbedo = {0.5, 0.5, 0.5}};  // at +z
  const Picture picture = SkyModel(parameters).picture(2);
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
  const SkyModel model(parameters);
  const double of_sun = model.sun().green * std::sin(std::numbers::pi / 6) * 0.5 / std::numbers::pi;
  CHECK(texel(100, 300).green > of_sun);
  CHECK(texel(100, 300).green < 2 * of_sun);
}

TEST_CASE("a skylight is as bright as its scaleradiance says") {
  const SkyModel one({.sundirection = {1, 1, 1}}), three({.sundirection = {1, 1, 1}, .scaleradiance = 3});
  CHECK(three.sky(towards(50, 10)).green == Approx(3 * one.sky(towards(50, 10)).green));
  CHECK(three.sun().green == Approx(3 * one.sun().green));
}

}  // namespace raytrace::test
