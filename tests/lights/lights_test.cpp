// The way from points to lights, and what they send.
#include <limits>

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
  light.sample(arriving.rays, arriving.radiance);
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

}  // namespace raytrace::test
