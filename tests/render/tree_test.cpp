// When Embree's tree is built: at once, later, or not at all.
#include <random>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"

namespace raytrace::test {

namespace {

/// So many spheres that their tree is not built before a ray wants it, and what `more` adds, over an endless floor and
/// under a light.
SceneDescription many_spheres(const std::string& more) {
  std::mt19937 bits(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits()) / 4294967296.0;
  };
  std::string spheres;
  for (int i = 0; i < 20000; ++i) {
    const double x = between(-10, 10), z = between(-10, 10), radius = between(0.02, 0.1);
    spheres += "<sphere>" + vector_text("center", x, between(0, 3), z) + "<radius>" + std::to_string(radius) +
               "</radius><material>m</material></sphere>";
  }
  return parsed_scene(scene_text(
      200, 150, 4,
      "<lights><pointlights><pointlight>" + vector_text("location", 5, 40, 8) +
          "<scaleradiance>3</scaleradiance></pointlight></pointlights></lights><materials><mattes><matte><name>m</name>"
          "<ka>0</ka><kd>1</kd><cd red='0.5' green='0.6' blue='0.7'/></matte></mattes></materials><objects><planes>"
          "<plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>m</material></plane></planes>"
          "<spheres>" +
          spheres + more + "</spheres></objects>",
      "<eye x='0' y='2' z='30'/><lookat x='0' y='1' z='0'/>"));
}

}  // namespace

TEST_CASE("a tree that no ray wants is not built, though the floor goes on to the horizon") {
  const SceneDescription description = many_spheres("");
  const auto scene = build_scene(description, {2, ""});
  RayCounts rays;
  render(*scene, description, {2, 0, whole(description)}, rays);
  CHECK(rays.shadow > 10000);
  CHECK(scene->statistics().bvh_bytes == 0);
}

TEST_CASE("a tree that rays want is built by as many threads as come, and is the same") {
  // From a light so close to a sphere there are no lists.
  const SceneDescription description =
      many_spheres("<sphere><center x='5' y='41.05' z='8'/><radius>1</radius><material>m</material></sphere>");
  const FloatPicture wanted = rendered(description, 1);
  for (int repeat = 0; repeat < (is_sanitized ? 2 : 5); ++repeat) {
    const auto scene = build_scene(description, {4, ""});
    CHECK(scene->statistics().bvh_bytes == 0);
    RayCounts rays;
    const FloatPicture picture = render(*scene, description, {4, 0, whole(description)}, rays);
    CHECK(rays.shadow > 10000);
    CHECK(scene->statistics().bvh_bytes > 0);
    CHECK(identical(picture, wanted));
  }
}

}  // namespace raytrace::test
