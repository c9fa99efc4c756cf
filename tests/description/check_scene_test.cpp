// Descriptions that a program has made, held against the rules of the format.
#include "raytrace/description/check_scene.h"

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/description/motion.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Two spheres and a triangle in clay under all lights.
SceneDescription good_scene() {
  SceneDescription scene;
  scene.viewplane.hres = 4;
  scene.viewplane.vres = 3;
  PinholeCamera::Parameters camera;
  camera.eye = {0, 0, 9};
  camera.viewdistance = 4;
  scene.camera = camera;
  std::get<LightItems<AmbientLight>>(scene.lights).resize(1);
  std::get<LightItems<PointLight>>(scene.lights).resize(1);
  std::get<LightItems<DirectionalLight>>(scene.lights).push_back({{.direction = {0, 1, 0}}, 0});
  std::get<MaterialItems<Matte>>(scene.materials).push_back({{.ka = 1, .kd = 1, .cd = {1, 1, 1}}, "clay", 0});
  const Sphere::Parameters sphere{{0, 0, 0}, 1};
  std::get<ObjectItems<Sphere>>(scene.objects) = {{sphere, "", {}, 0}, {sphere, "ball", {}, 0}};
  std::get<ObjectItems<Triangle>>(scene.objects).push_back({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "", {}, 0});
  return scene;
}

std::string errors_of(const std::function<void(SceneDescription&)>& change) {
  SceneDescription scene = good_scene();
  change(scene);
  Diagnostics diagnostics("s");
  check_scene(scene, diagnostics);
  std::ostringstream text;
  diagnostics.print(text);
  return text.str();
}

auto& first_sphere(SceneDescription& scene) { return std::get<ObjectItems<Sphere>>(scene.objects)[0]; }
auto& camera(SceneDescription& scene) { return std::get<PinholeCamera::Parameters>(scene.camera); }
auto& matte(SceneDescription& scene) { return std::get<MaterialItems<Matte>>(scene.materials)[0]; }

}  // namespace

TEST_CASE("a good description has no error, nor has one that was read") {
  CHECK(errors_of([](SceneDescription&) {}) == "");
  CHECK_NOTHROW(require_good_scene(good_scene()));
  CHECK_NOTHROW(require_good_scene(
      accepted(scene_with_sphere("<center x='0' y='0' z='0'/><radius>1</radius><material>steel</material>"))));
}

TEST_CASE("each rule of the format holds for a description that a program has made") {
  using Scene = SceneDescription;
  CHECK(errors_of([](Scene& s) { s.viewplane.hres = 0; }) ==
        "s: error: <viewplane> has '0' as <hres>, which must be at least 1\n");
  CHECK(contains(errors_of([](Scene& s) { s.viewplane.samples = 0; }), "as <samples>, which must be at least 1"));
  CHECK(contains(errors_of([](Scene& s) { s.viewplane.hres = 70000; }), "beyond the limit of 65536 pixels an edge"));
  CHECK(
      contains(errors_of([](Scene& s) { s.viewplane.background.green = nan; }), "'nan' as <background>, which is not"));
  CHECK(contains(errors_of([](Scene& s) { camera(s).lookat = camera(s).eye; }),
                 "<camera>: the camera's <eye> and <lookat> are the same point"));
  CHECK(contains(errors_of([](Scene& s) { camera(s).up = {0, 0, 0}; }), "a <up> of length 0; it is a direction"));
  CHECK(contains(errors_of([](Scene& s) { camera(s).viewdistance = 0; }), "must be greater than 0"));
  CHECK(errors_of([](Scene& s) { first_sphere(s).parameters.radius = -1; }) ==
        "s: error: <sphere> [0] has '-1' as <radius>, which must be greater than 0\n");
  CHECK(contains(errors_of([](Scene& s) { first_sphere(s).parameters.radius = nan; }), "not a finite number"));
  CHECK(contains(errors_of([](Scene& s) { first_sphere(s).parameters.center.y = infinite; }),
                 "'inf' as <center>, which is not"));
  CHECK(contains(errors_of([](Scene& s) { first_sphere(s).parameters.center.x = 1e18; }), "beyond the largest number"));
  CHECK(contains(errors_of([](Scene& s) { first_sphere(s).parameters.radius = 1e-20; }), "too small"));
  CHECK(contains(errors_of([](Scene& s) { matte(s).parameters.kd = -1; }),
                 "<matte> [0] has '-1' as <kd>, which must not"));
  CHECK(contains(errors_of([](Scene& s) { matte(s).name = ""; }), "<matte> [0] has '' as <name>, which is empty"));
  for (const char* const name : {"a  b", "a\nb", " a", "a ", "a\x01", "\xff"})
    CHECK(contains(errors_of([&](Scene& s) { matte(s).name = name; }), "<matte> [0] has '"));
  CHECK(contains(errors_of([](Scene& s) { first_sphere(s).name = "ball"; }),
                 "<sphere> [1] has the object name 'ball' of <sphere> [0]; choose another"));
  CHECK(contains(errors_of([](Scene& s) { std::get<MaterialItems<Phong>>(s.materials).push_back({{}, "clay", 0}); }),
                 "<phong> [0] has the material name 'clay' of <matte> [0]"));
  CHECK(errors_of([](Scene& s) { first_sphere(s).material.index = 1; }) ==
        "s: error: <sphere> [0] refers to material 1 of type 0, which is not there\n");
  CHECK(contains(errors_of([](Scene& s) { first_sphere(s).material.type = 77; }),
                 "material 0 of type 77, which is not there"));
  CHECK(contains(errors_of([](Scene& s) {
                   std::get<LightItems<PointLight>>(s.lights)[0].parameters.falloff = static_cast<Falloff>(2);
                 }),
                 "<pointlight> [0] has '2' as <falloff>, which is neither none nor inversesquare"));
  CHECK(contains(errors_of([](Scene& s) { std::get<LightItems<AmbientLight>>(s.lights).resize(2); }),
                 "<ambientlight> [1] is a second one"));
  CHECK(contains(
      errors_of([](Scene& s) { std::get<LightItems<DirectionalLight>>(s.lights)[0].parameters.direction = {0, 0, 0}; }),
      "<directionallight> [0] has a <direction> of length 0"));
  CHECK(errors_of([](Scene& s) { first_sphere(s).line = 7, first_sphere(s).parameters.radius = 0; }) ==
        "s:7: error: <sphere> [0] has '0' as <radius>, which must be greater than 0\n");
}

TEST_CASE("what moves by hand has all moments of one type") {
  using Scene = SceneDescription;
  const auto moves = [](Scene& s, std::size_t moments) { s.moving_camera.assign(moments, s.camera); };
  CHECK(errors_of([&](Scene& s) { moves(s, shutter_moments); }) == "");
  CHECK(errors_of([&](Scene& s) { moves(s, 1); }) ==
        "s: error: <camera> moves, with 1 moments; it takes 17 (motion.h), or none\n");
  CHECK(errors_of([&](Scene& s) {
          moves(s, shutter_moments), s.moving_camera[3] = OrthographicCamera::Parameters{};
        }) == "s: error: <camera> is of another type at a moment of its motion than at rest\n");
  CHECK(contains(errors_of([&](Scene& s) {
                   moves(s, shutter_moments);
                   std::get<PinholeCamera::Parameters>(s.moving_camera[3]).viewdistance = 0;
                 }),
                 "must be greater than 0"));
}

TEST_CASE("AOVs that there are not are refused") {
  CHECK(aov_names(aov_set({"depth", "light_key"})) == std::vector<std::string>{"depth", "light_key"});
  CHECK_THROWS_AS(aov_set({"depth", "nonsense"}), std::invalid_argument);
}

TEST_CASE("what the steps of a transform make together is held against the rules, too") {
  using Scene = SceneDescription;
  const auto scaled = [](double by, std::size_t times) {
    return errors_of(
        [&](Scene& s) { first_sphere(s).transform.steps.assign(times, {TransformStep::scale, {by, by, by}}); });
  };
  CHECK(scaled(1e8, 2) == "");
  for (const auto& all : {scaled(1e10, 2), scaled(1e16, 20)})
    CHECK(contains(all, "<sphere> [0] has a transform that makes, with all its steps, a matrix with a number beyond"));
  CHECK(contains(scaled(1e-5, 2), "<sphere> [0] has a transform that flattens the object"));
  const auto with_instance = [](const Affine& outer) {
    return errors_of([&](Scene& s) {
      s.groups = {{"a", {}, 0, 0}, {"b", {}, 0, 0}};
      std::get<ObjectItems<Sphere>>(s.groups[0].objects).push_back(first_sphere(s));
      ObjectItem<Instance> instance;
      instance.parameters.group.name = "a";
      instance.transform.steps = {{TransformStep::scale, {1e10, 1e10, 1e10}}};
      std::get<ObjectItems<Instance>>(s.groups[1].objects).push_back(instance);
      instance.parameters.group.name = "b";
      instance.transform.steps = {{TransformStep::scale, {outer.x.x, outer.y.y, outer.z.z}}};
      instance.motion.assign(shutter_moments, outer);
      std::get<ObjectItems<Instance>>(s.objects).push_back(instance);
    });
  };
  CHECK(with_instance({}) == "");
  CHECK(contains(with_instance({{1e10, 0, 0}, {0, 1e10, 0}, {0, 0, 1e10}, {}}),
                 "the <instance>, with those in its group 'b', makes objects too large"));
  CHECK(contains(with_instance({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {nan, 0, 0}}), "<instance> [0] has a motion that"));
  // However deep they are, turns make nothing larger.
  CHECK(errors_of([](Scene& s) {
          for (int i = 0; i < 200; ++i) {
            Group& group = s.groups.emplace_back(Group{"g" + std::to_string(i), {}, 0, 0});
            if (i == 0) continue;
            ObjectItem<Instance>& instance = std::get<ObjectItems<Instance>>(group.objects).emplace_back();
            instance.parameters.group.name = "g" + std::to_string(i - 1);
            instance.transform.steps = {{TransformStep::rotate, {1, 2, 3, 40}}};
          }
        }) == "");
}

TEST_CASE("all errors are reported at once, and warnings alone are none") {
  SceneDescription scene = good_scene();
  first_sphere(scene).parameters.radius = 0;
  first_sphere(scene).material.index = 9;
  try {
    require_good_scene(scene);
    FAIL("nothing was thrown");
  } catch (const SceneError& error) {
    CHECK(error.what() == std::string("scene: error: <sphere> [0] refers to material 9 of type 0, which is not there\n"
                                      "scene: error: <sphere> [0] has '0' as <radius>, which must be greater than 0"));
  }
  const auto flatten = [](SceneDescription& s) {
    std::get<ObjectItems<Triangle>>(s.objects)[0].parameters.vertex3 = {2, 0, 0};
  };
  CHECK(contains(errors_of(flatten), "s: warning: <triangle> [0]: the triangle is degenerate"));
  scene = good_scene();
  flatten(scene);
  CHECK_NOTHROW(require_good_scene(scene));
}

}  // namespace raytrace::test
