// What light paths bring to a picture that is to be denoised: each to one pixel, whatever the filter.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <string>
#include <vector>

#include "raytrace/film/splat_layer.h"
#include "raytrace/sampling/footprint.h"
#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

/// A mirror that throws light on the floor, by a wide filter.
const std::string scene_text_of_mirror =
    "<raytracer><integrator><path><caustics>light</caustics></path></integrator>"
    "<viewplane><hres>24</hres><vres>16</vres><samples>16</samples><filter>blackmanharris</filter></viewplane>"
    "<camera><eye x='0' y='5' z='5'/><lookat x='0' y='0' z='0'/><fov>30</fov></camera>"
    "<lights><pointlights><pointlight><location x='-3' y='2' z='0'/></pointlight></pointlights></lights>"
    "<materials><mattes><matte><name>floor</name><ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte></mattes>"
    "<mirrors><mirror><name>mirror</name><cr red='1' green='1' blue='1'/></mirror></mirrors></materials><objects>"
    "<rectangles><rectangle><corner x='-5' y='0' z='5'/><edge1 x='10' y='0' z='0'/><edge2 x='0' y='0' z='-10'/>"
    "<material>floor</material></rectangle><rectangle><corner x='4' y='0' z='5'/><edge1 x='0' y='0' z='-10'/>"
    "<edge2 x='0' y='6' z='0'/><material>mirror</material></rectangle></rectangles></objects></raytracer>";

struct Splats {
  std::vector<double> means;      ///< of each pixel
  double variance = 0, next = 0;  ///< of pixels, and the covariance with the next to the right
};

Splats splats_of(bool single) {
  constexpr int renders = 60;
  const SceneDescription description = parsed_scene(scene_text_of_mirror);
  const auto scene = build_scene(description, {1, {}});
  const Region all = whole(description);
  std::vector<std::vector<double>> values;
  for (int i = 0; i < renders; ++i) {
    RenderSettings settings;
    settings.threads = 1;
    settings.region = all;
    settings.seed = static_cast<std::uint64_t>(i) + (single ? 1000 : 0);
    settings.single_splats = single;
    RayCounts rays;
    const Film film = render(*scene, description, settings, rays);
    std::vector<double>& picture = values.emplace_back();
    for (int y = all.y0; y < all.y1; ++y)
      for (int x = all.x0; x < all.x1; ++x)
        picture.push_back(std::ldexp(static_cast<double>(film.splats()->sum(x, y)[1]), film.settings().unit_exponent));
  }
  Splats result;
  const auto width = static_cast<std::size_t>(all.width());
  for (std::size_t pixel = 0; pixel < values[0].size(); ++pixel) {
    double sum = 0;
    for (const auto& picture : values) sum += picture[pixel];
    result.means.push_back(sum / renders);
  }
  for (std::size_t pixel = 0; pixel < values[0].size(); ++pixel)
    for (const auto& picture : values) {
      const double apart = picture[pixel] - result.means[pixel];
      result.variance += apart * apart;
      if (pixel % width + 1 < width) result.next += apart * (picture[pixel + 1] - result.means[pixel + 1]);
    }
  return result;
}

}  // namespace

TEST_CASE("splats in one pixel each have the same mean, and no noise in common") {
  const Splats spread = splats_of(false), single = splats_of(true);
  double all_spread = 0, all_single = 0;
  for (std::size_t i = 0; i < spread.means.size(); ++i) {
    all_spread += spread.means[i];
    all_single += single.means[i];
  }
  REQUIRE(all_spread > 0);
  CHECK(all_single == Approx(all_spread).epsilon(0.01));
  CHECK(spread.next > 0.2 * spread.variance);
  CHECK(std::abs(single.next) < 0.1 * single.variance);
}

TEST_CASE("a footprint's one pixel has the filter's share, on average") {
  ViewPlane viewplane;
  viewplane.filter = PixelFilter::blackman_harris;
  const FilterTable filter(viewplane);
  for (const double at : {10.0, 10.3, 10.5, 10.9}) {
    const Footprint all(filter, at, std::nullopt);
    CHECK(all.last() > all.first());
    std::vector<double> got(30, 0);
    constexpr int draws = 10000;
    for (int i = 0; i < draws; ++i) {
      const Footprint one(filter, at, (i + 0.5) / draws);
      REQUIRE(one.first() == one.last());
      got[static_cast<std::size_t>(one.first())] += one.share(one.first()) / draws;
    }
    for (int pixel = 0; pixel < 30; ++pixel) {
      const bool within = pixel >= all.first() && pixel <= all.last();
      CHECK(got[static_cast<std::size_t>(pixel)] == Approx(within ? all.share(pixel) : 0).margin(1e-3));
    }
  }
}

TEST_CASE("a box of a pixel's width has one pixel anyway") {
  const FilterTable filter{ViewPlane()};
  for (const auto& chance : {std::optional<double>(), std::optional<double>(0.7)}) {
    const Footprint one(filter, 3.75, chance);
    CHECK(one.first() == 3);
    CHECK(one.last() == 3);
    CHECK(one.share(3) == 1);
  }
}

}  // namespace raytrace::test
