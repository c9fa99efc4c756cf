// Directional lights that are disks, and skylights: soft shadows, and as much light as they should give.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>

#include "raytrace/lights/sky_model.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

constexpr double pi = std::numbers::pi;

/// A white floor at y = 0 under a sun whose irradiance is pi, so that radiance 1 leaves the floor where it faces it;
/// the camera looks down at (x, 0, 0).
std::string sunlit_floor(const std::string& direction, double angle, double x, const std::string& above = "") {
  return "<raytracer><viewplane><hres>8</hres><vres>8</vres><samples>256</samples></viewplane>"
         "<camera>" +
         vector_text("eye", x, 0.5, 0.001) + vector_text("lookat", x, 0, 0) +
         "<fov>0.01</fov></camera>"
         "<integrator><raycast/></integrator><lights><directionallights><directionallight>" +
         direction + "<scaleradiance>3.14159265358979</scaleradiance><angle>" + std::to_string(angle) +
         "</angle></directionallight></directionallights></lights><materials><mattes><matte><name>m</name><ka>0</ka>"
         "<kd>1</kd><cd red='1' green='1' blue='1'/></matte></mattes></materials><objects><planes><plane>"
         "<point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>m</material></plane></planes>" +
         above + "</objects></raytracer>";
}

const std::string overhead = "<direction x='0' y='1' z='0'/>";

}  // namespace

TEST_CASE("a floor is as bright under a sun as under a light without a size") {
  for (const double angle : {0.0, 0.53, 40.0, 180.0}) {
    INFO(angle);
    CHECK(std::abs(mean_green(rendered(sunlit_floor(overhead, angle, 0))) - 1) < 0.002);
  }
  // Aslant, it is the cosine of the disk's middle, as long as all of the disk is above the horizon.
  CHECK(std::abs(mean_green(rendered(sunlit_floor("<direction x='3' y='4' z='0'/>", 40, 0))) - 0.8) < 0.002);
}

TEST_CASE("in a sun's penumbra arrives what the part of the disk sends that is in view") {
  // The edge of a roof 10 units above x = 0 hides what is at lower x.
  const std::string roof =
      "<rectangles><rectangle><corner x='-100' y='10' z='-100'/><edge1 x='100' y='0' z='0'/><edge2 x='0' y='0' "
      "z='200'/><material>m</material></rectangle></rectangles>";
  const double reach = 10 * std::tan(pi / 180);
  const auto seen_at = [&](double part) { return mean_green(rendered(sunlit_floor(overhead, 2, part * reach, roof))); };
  const auto share = [](double part) { return 0.5 + (std::asin(part) + part * std::sqrt(1 - part * part)) / pi; };
  CHECK(seen_at(-1.05) == 0);
  CHECK(std::abs(seen_at(1.05) - 1) < 0.001);
  for (const double part : {-0.5, 0.0, 0.5}) {
    INFO(part);
    CHECK(std::abs(seen_at(part) - share(part)) < 0.01);
  }
}

TEST_CASE("a scene with a sun is rendered by paths, unless it says otherwise") {
  std::string text = busy_scene(20, 15, 4);
  const auto with = [&](const std::string& integrator, const std::string& angle) {
    std::string changed = text;
    changed.insert(changed.find("<directionallight>") + 18, "<angle>" + angle + "</angle>");
    return rendered(changed.insert(changed.find("<raytracer>") + 11, integrator));
  };
  const std::string path = "<integrator><path/></integrator>", raycast = "<integrator><raycast/></integrator>";
  CHECK(identical(with("", "5"), with(path, "5")));
  CHECK(identical(with("", "0"), with(raycast, "0")));
  CHECK_FALSE(identical(with(raycast, "5"), with(path, "5")));
}

TEST_CASE("a sun's light does not depend on threads, samples at once, or how the picture is cut") {
  std::string text = busy_scene(41, 37, 16);
  text.insert(text.find("<directionallight>") + 18, "<angle>20</angle>");
  SceneDescription description = parsed_scene(text);
  for (const std::string& isa : usable_isas()) {
    INFO(isa);
    description.integrator = Path::Parameters{.maxdepth = 1};
    const FloatPicture by_path = rendered(description, 1, isa);
    description.integrator = Raycast::Parameters{};
    const FloatPicture all = rendered(description, 1, isa);
    CHECK(identical(by_path, all));
  }
  check_same_bits(description);
}

TEST_CASE("a floor under a skylight is as bright as the ground that the sky's picture has") {
  std::string text = sunlit_floor(overhead, 0, 0);
  const std::size_t from = text.find("<integrator>"), to = text.find("<materials>");
  text.replace(
      from, to - from,
      "<lights><skylights><skylight><sundirection x='1' y='1' z='0.5'/><groundalbedo red='1' green='1' blue='1'/>"
      "</skylight></skylights></lights>");
  const Picture sky = SkyModel({.sundirection = {1, 1, 0.5}, .groundalbedo = {1, 1, 1}}, 1).picture();
  float green = 0;
  std::memcpy(&green, sky.pixels.data() + (std::size_t{4} * 1024 * 512 - 3) * sizeof green, sizeof green);
  const double floor = mean_green(rendered(text));
  INFO(floor << " for " << green);
  CHECK(std::abs(floor / double{green} - 1) < 0.01);
}

}  // namespace raytrace::test
