// Lights that are drawn bring, over all draws, what they bring when each is asked.
//
// Wide code is compiled for each instruction set apart, so the test has its own.
#include "raytrace/scene/many_lights.cpp"  // NOLINT(bugprone-suspicious-include)

#include <memory>
#include <random>
#include <vector>

#include "raytrace/lights/kernels.h"
#include "raytrace/scene/light_source.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

using Lights = std::vector<std::unique_ptr<LightSource>>;

/// Points and spots, with and without shadows and photometry, one that is dark, and some that stand in one place.
Lights mixed_lights(int count) {
  const std::string lamps[] = {"IESNA91\nTILT=NONE\n1 1000 1 4 1 1 1 0 0 0\n1 1 50\n0 30 60 90\n0\n100 80 30 0\n",
                               "IESNA91\nTILT=NONE\n1 1000 1 3 3 1 1 0 0 0\n1 1 50\n0 90 180\n0 90 180\n"
                               "10 80 30 10 20 5 10 3 1\n"};
  std::vector<LoadedPhotometry> files{{}};
  for (const std::string& lamp : lamps)
    files.push_back({"a", std::make_shared<const Photometry>(read_photometry(lamp))});
  std::mt19937 bits(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits()) / 4294967296.0;
  };
  Lights lights;
  for (int i = 0; i < count; ++i) {
    Vec3d location{number(-4, 4), number(-1, 3), number(-4, 4)};
    if (i % 11 == 3) location = {1, 2, 3};
    const Rgb<double> color{number(0.1, 1), number(0.1, 1), number(0.1, 1)};
    const double radiance = i % 13 == 5 ? 0 : std::pow(10, number(-1, 1));
    const LoadedPhotometry& file = files[static_cast<std::size_t>(i) / 2 % 3];
    const bool shadows = i % 5 != 2;
    if (i % 2 == 0) {
      lights.push_back(std::make_unique<LightSourceOf<Kernel<PointLight>>>(
          Kernel<PointLight>({location, radiance, color, shadows, Falloff::inverse_square, {}, {}}, file)));
    } else {
      const Vec3d lookat{number(-3, 3), number(-3, 0), number(-3, 3)};
      const double angle = i % 3 == 0 ? 360 : number(20, 200);
      lights.push_back(std::make_unique<LightSourceOf<Kernel<SpotLight>>>(Kernel<SpotLight>({location,
                                                                                             lookat,
                                                                                             angle,
                                                                                             i % 4 == 1 ? 0 : angle / 4,
                                                                                             radiance,
                                                                                             color,
                                                                                             shadows,
                                                                                             Falloff::inverse_square,
                                                                                             {},
                                                                                             {}},
                                                                                            file)));
    }
  }
  return lights;
}

}  // namespace

TEST_CASE("lights that are drawn bring, over all draws, what they bring when each is asked") {
  const Lights lights = mixed_lights(60);
  for (const LightSampling sampling : {LightSampling::tree, LightSampling::power, LightSampling::uniform}) {
    ManyLights many;
    for (const auto& light : lights) light->add_to(many);
    many.build(sampling);
    int point = 0;
    bool has_both = false;  // lights with shadows and without
    for (const auto& [p, normal] :
         {std::pair(Vec3d{0, 0, 0}, Vec3d{0, 1, 0}), std::pair(Vec3d{2, 1, 1}, Vec3d{-1, 0, 0}),
          std::pair(Vec3d{1, 1.5, 3}, Vec3d{0, 0.6, 0.8}), std::pair(Vec3d{-3, 0.5, -2}, Vec3d{0, 0, 0})}) {
      INFO("sampling " << static_cast<int>(sampling) << ", point " << point++);
      double asked = 0, asked_shadowed = 0, drawn = 0, drawn_shadowed = 0;
      Ray<FloatN> rays;
      rays.origin = spread(p);
      Rgb<FloatN> radiance;
      const auto green = [&] {
        const FloatN cosine = select(dot(spread(normal), spread(normal)) > FloatN(0),
                                     max(dot(spread(normal), normalize(rays.direction)), FloatN(0)), FloatN(1));
        return radiance.green * cosine;
      };
      for (const auto& light : lights) {
        light->sample(rays, {FloatN(0), FloatN(0)}, radiance);
        const double its = static_cast<double>(green().get(0));
        asked += its;
        if (light->shadows()) asked_shadowed += its;
      }
      constexpr std::size_t draws = 1U << 16U;
      for (std::size_t first = 0; first < draws; first += lanes) {
        const MaskN has_shadow = many.sample(rays, spread(normal), batch_of<FloatN>([&](std::size_t lane) {
                                               return (static_cast<double>(first + lane) + 0.5) / draws;
                                             }),
                                             radiance);
        const FloatN brought = green(), shadowed = select(has_shadow, brought, FloatN(0));
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          drawn += static_cast<double>(brought.get(lane)) / draws;
          drawn_shadowed += static_cast<double>(shadowed.get(lane)) / draws;
        }
      }
      has_both |= asked_shadowed > 0 && asked > asked_shadowed;
      CHECK(std::abs(drawn - asked) < 2e-3 * asked);
      CHECK(std::abs(drawn_shadowed - asked_shadowed) < 2e-3 * asked);
    }
    CHECK(has_both);
  }
}

TEST_CASE("of lights together, one is drawn by what it brings: one leaf of them brings the same with each draw") {
  ManyLights many;
  for (const auto& light : mixed_lights(8)) light->add_to(many);
  many.build(LightSampling::tree);
  Ray<FloatN> rays;
  rays.origin = spread({0, -2, 0});
  const Vec3<FloatN> normal = spread({0, 1, 0});
  Rgb<FloatN> radiance;
  many.sample(rays, normal,
              batch_of<FloatN>([](std::size_t lane) { return (static_cast<double>(lane) + 0.5) / lanes; }), radiance);
  const FloatN brought = (radiance.red + radiance.green + radiance.blue) * dot(normal, normalize(rays.direction));
  const double first = static_cast<double>(brought.get(0));
  REQUIRE(first > 0);
  for (std::size_t lane = 1; lane < lanes; ++lane)
    CHECK(std::abs(static_cast<double>(brought.get(lane)) - first) < 1e-5 * first);
}

}  // namespace raytrace::test
