// The way from points to lights, and what they send.
#include <cmath>
#include <limits>
#include <numbers>

#include "raytrace/lights/kernels.h"
#include "raytrace/scene/light_source.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

const Vec3<FloatN> positions = vectors_of([](std::size_t i) {
  const auto x = static_cast<double>(i);
  return Vec3d{x * x - 3, 0.5 - x, 1 / (1 + x)};
});

struct Arriving {
  Ray<FloatN> rays;
  Rgb<FloatN> radiance;
};

Arriving arriving_at(const Vec3<FloatN>& points, const LightSource& light) {
  Arriving arriving;
  arriving.rays.origin = points;
  light.sample(arriving.rays, {FloatN(0.25F), FloatN(0.75F)}, arriving.radiance);
  return arriving;
}

}  // namespace

TEST_CASE("a point light is reached from each point along the difference, and ends there") {
  const LightSourceOf<Kernel<PointLight>> light(Kernel<PointLight>({{2, 30, -4}, 3, {1, 0.5, 0.25}, true}));
  const Ray<FloatN> rays = arriving_at(positions, light).rays;
  CHECK(all(rays.far == FloatN(1)));
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3d reached = lane_of(positions, lane) + lane_of(rays.direction, lane);
    CHECK(length(reached - Vec3d{2, 30, -4}) < 1e-5);
  }
}

TEST_CASE("a directional light lies in the same direction from everywhere, infinitely far") {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const LightSourceOf<Kernel<DirectionalLight>> light(
        Kernel<DirectionalLight>({Vec3d{3, -4, 12} * scale, 1, {1, 1, 1}, true}));
    const Ray<FloatN> rays = arriving_at(positions, light).rays;
    CHECK(all(rays.far == FloatN(std::numeric_limits<float>::infinity())));
    for (std::size_t lane = 0; lane < lanes; ++lane)
      CHECK(length(normalize(lane_of(rays.direction, lane)) - Vec3d{3.0 / 13, -4.0 / 13, 12.0 / 13}) < 1e-6);
  }
}

TEST_CASE("a directional light with an angle comes from all of its disk, and sends as much in the mean") {
  for (const double angle : {0.5, 30.0, 180.0}) {
    const Kernel<DirectionalLight> light({.direction = {1, -2, 2}, .scaleradiance = 3, .angle = angle});
    CHECK(light.takes_samples());
    const Vec3d axis{1 / 3.0, -2 / 3.0, 2 / 3.0};
    double lowest = 1, sum = 0, length_error = 0;
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; j += packet_lanes) {
        const FloatN u1((static_cast<float>(i) + 0.5F) / steps);
        const FloatN u2 = batch_of<FloatN>([&](std::size_t lane) { return (j + double(lane) + 0.5) / steps; });
        const LightSample<FloatN> sample = light.sample(positions, u1, u2);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          const Vec3d wi = lane_of(sample.to_light, lane);
          const double cosine = dot(wi, axis);
          lowest = std::min(lowest, cosine);
          length_error = std::max(length_error, std::abs(length(wi) - 1));
          sum += cosine * double{sample.radiance.green.get(lane)} / (steps * steps);
        }
      }
    INFO(angle);
    const double edge = std::cos(angle * std::numbers::pi / 360);
    CHECK(lowest >= edge - 1e-6);
    CHECK(1 - lowest > 0.98 * (1 - edge));
    CHECK(length_error < 1e-6);
    CHECK(sum == Approx(3).epsilon(1e-4));
  }
  CHECK_FALSE(Kernel<DirectionalLight>({.direction = {1, -2, 2}}).takes_samples());
}

TEST_CASE("a light's radiance is its color times its scale, and shadows are cast as it says") {
  const auto check = [](const Rgb<float>& radiance) {
    CHECK(radiance.red == 3.0f);
    CHECK(radiance.green == 1.5f);
    CHECK(radiance.blue == 0.75f);
  };
  const auto sampled = [](const LightSource& light) {
    const Rgb<FloatN> radiance = arriving_at({FloatN(1), FloatN(2), FloatN(3)}, light).radiance;
    return Rgb<float>(radiance.red.get(1), radiance.green.get(1), radiance.blue.get(1));
  };
  check(Kernel<AmbientLight>({3, {1, 0.5, 0.25}}).radiance());
  for (const bool shadows : {true, false}) {
    const Kernel<PointLight> point({{0, 0, 0}, 3, {1, 0.5, 0.25}, shadows});
    const Kernel<DirectionalLight> directional({{0, 1, 0}, 3, {1, 0.5, 0.25}, shadows});
    check(sampled(LightSourceOf<Kernel<PointLight>>(point)));
    check(sampled(LightSourceOf<Kernel<DirectionalLight>>(directional)));
    CHECK(LightSourceOf<Kernel<PointLight>>(point).shadows() == shadows);
    CHECK(LightSourceOf<Kernel<DirectionalLight>>(directional).shadows() == shadows);
  }
}

TEST_CASE("a light that a scene says nothing more about is white, of radiance 1, and casts shadows") {
  const PointLight::Parameters point;
  const DirectionalLight::Parameters directional;
  CHECK(Kernel<PointLight>(point).sample(Vec3f(0, 0, 0)).radiance.green == 1.0f);
  CHECK(Kernel<PointLight>(point).shadows());
  CHECK(Kernel<DirectionalLight>({{0, 1, 0}, directional.scaleradiance, directional.color, directional.shadows})
            .shadows());
  CHECK(Kernel<AmbientLight>(AmbientLight::Parameters{}).radiance().blue == 1.0f);
}

namespace {

/// What a light sends to a point.
template <class Light>
Rgb<float> radiance_at(const typename Light::Parameters& parameters, const Vec3d& p) {
  const LightSourceOf<Kernel<Light>> light{Kernel<Light>(parameters)};
  const Rgb<FloatN> radiance = arriving_at(spread(p), light).radiance;
  return {radiance.red.get(1), radiance.green.get(1), radiance.blue.get(1)};
}

SpotLight::Parameters spotlight(double coneangle, double penumbraangle) {
  SpotLight::Parameters parameters;
  parameters.location = {1, 5, 2};
  parameters.lookat = {1, 0, 2};
  parameters.coneangle = coneangle;
  parameters.penumbraangle = penumbraangle;
  parameters.color = {1, 0.5, 2};
  return parameters;
}

/// A point that is so many degrees from the axis of that light, at a distance.
Vec3d off_axis(double degrees, double distance = 3) {
  const double angle = degrees * std::numbers::pi / 180;
  return {1 + distance * std::sin(angle), 5 - distance * std::cos(angle), 2};
}

}  // namespace

TEST_CASE("light that falls off with the square of the distance has its full radiance at distance 1") {
  PointLight::Parameters parameters{{1, 0, 0}, 3, {1, 0.5, 0.25}, true, Falloff::inverse_square};
  for (const double distance : {0.001, 0.5, 1.0, 2.0, 1e6}) {
    const Rgb<float> radiance = radiance_at<PointLight>(parameters, {1 + distance, 0, 0});
    const double squared = std::pow(double{static_cast<float>(1 + distance)} - 1, 2);
    CHECK(radiance.red == Approx(3 / squared).epsilon(1e-5));
    CHECK(radiance.blue == Approx(0.75 / squared).epsilon(1e-5));
  }
  CHECK(std::isfinite(radiance_at<PointLight>(parameters, {1, 0, 0}).red));  // and at the light itself
  for (const double scale : {1e17, -1e17}) {
    parameters.scaleradiance = scale;
    CHECK(std::isfinite(radiance_at<PointLight>(parameters, {1, 1e-17, 0}).red));
  }
  parameters.falloff = Falloff::none;
  CHECK(radiance_at<PointLight>(parameters, {1e6, 0, 0}).red == static_cast<float>(-1e17));
}

TEST_CASE("a spotlight without penumbra shines evenly inside its cone, and not outside") {
  for (const double cone : {10.0, 90.0, 180.0, 270.0}) {
    const SpotLight::Parameters parameters = spotlight(cone, 0);
    CHECK(radiance_at<SpotLight>(parameters, off_axis(0)).blue == 2);
    CHECK(radiance_at<SpotLight>(parameters, off_axis(cone / 2 - 0.01)).green == 0.5F);
    CHECK(radiance_at<SpotLight>(parameters, off_axis(cone / 2 + 0.01)).green == 0);
    CHECK(radiance_at<SpotLight>(parameters, parameters.location).red == 0);  // which is in no direction
  }
}

TEST_CASE("a spotlight's penumbra grows smoothly from its edge inwards") {
  const SpotLight::Parameters parameters = spotlight(60, 10);
  const double edge = std::cos(std::numbers::pi / 6), inner = std::cos(std::numbers::pi / 9);
  for (const double degrees : {29.9, 28.0, 25.0, 22.0, 20.1}) {
    const double x = (std::cos(degrees * std::numbers::pi / 180) - edge) / (inner - edge);
    CHECK(radiance_at<SpotLight>(parameters, off_axis(degrees)).red == Approx(x * x * (3 - 2 * x)).margin(1e-5));
  }
  CHECK(radiance_at<SpotLight>(parameters, off_axis(19.9)).red == 1);
  CHECK(radiance_at<SpotLight>(parameters, off_axis(30.1)).red == 0);
}

TEST_CASE("a spotlight falls off as a point light does") {
  SpotLight::Parameters parameters = spotlight(60, 10);
  parameters.falloff = Falloff::inverse_square;
  CHECK(radiance_at<SpotLight>(parameters, off_axis(5, 3)).red == Approx(1.0 / 9).epsilon(1e-5));
  CHECK(radiance_at<SpotLight>(parameters, off_axis(40, 3)).red == 0);
}

}  // namespace raytrace::test
