// Descriptions that a program has made, built and rendered: what is wrong with them is said before anything is done.
#include "raytrace/raytrace.h"
#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

TEST_CASE("a description that breaks the rules is refused before it is built") {
  SceneDescription description = parsed_scene(busy_scene(8, 8, 1));
  std::get<ObjectItems<Sphere>>(description.objects)[0].material.index = 1000;
  CHECK_THROWS_AS(build_scene(description, {1, {}}), SceneError);
  CHECK_THROWS_AS(build_scene({}, {1, {}}), SceneError);
}

TEST_CASE("without a region the whole picture is rendered, and one without pixels is refused") {
  SceneDescription description = parsed_scene(busy_scene(24, 16, 2));
  const auto scene = build_scene(description, {1, {}});
  RayCounts rays;
  const Film all = render(*scene, description, {1}, rays);
  CHECK(all.region() == whole(description));
  CHECK(identical(FloatPicture(all), FloatPicture(render(*scene, description, {1, 0, whole(description)}, rays))));
  for (const Region& region : {Region{3, 3, 3, 9}, Region{9, 3, 3, 9}, Region{0, 5, 8, 5}})
    CHECK_THROWS_AS(render(*scene, description, {1, 0, region}, rays), RenderError);
  CHECK_THROWS_AS(render(*scene, description, {1, 0, {}, SampleRange{0, 0, false}}, rays), RenderError);
  description.viewplane.samples = 0;
  CHECK_THROWS_AS(render(*scene, description, {1}, rays), SceneError);
}

TEST_CASE("a degenerate triangle in a description changes nothing") {
  SceneDescription description = parsed_scene(busy_scene(24, 16, 2));
  const FloatPicture without = rendered(description);
  auto& triangles = std::get<ObjectItems<Triangle>>(description.objects);
  triangles.push_back({{{-1, 0, 0}, {0, 1, 0}, {1, 2, 0}}, "", triangles.at(0).material, 0});
  triangles.push_back({{{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}, "", triangles.at(0).material, 0});
  CHECK(identical(rendered(description), without));
}

}  // namespace raytrace::test
