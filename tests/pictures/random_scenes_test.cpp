// The picture equals the formulas of the scene format: random scenes through the whole library, from scene text to
// film, against the reference.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "pictures/comparison.h"
#include "reference/moving.h"
#include "reference/renderer.h"
#include "reference/scene.h"
#include "reference/transformed.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// Pixels at silhouettes and shadow edges may fall to either side.
constexpr double tolerance = 1e-3;
constexpr double most_differing = 0.002;

/// change_scene(scene) and change_description(description): what is other than in the random scenes.
template <class ChangeScene, class ChangeDescription>
void check_scenes(unsigned first, unsigned last, const ChangeScene& change_scene,
                  const ChangeDescription& change_description) {
  for (unsigned seed = first; seed < last; ++seed) {
    reference::Scene scene = reference::random_scene(seed);
    if constexpr (requires { change_scene(scene, seed); })
      change_scene(scene, seed);
    else
      change_scene(scene);
    const std::string text = reference::scene_text(scene);
    SceneDescription description = parsed_scene(text);
    change_description(description);
    const Picture wanted = reference_picture(scene);
    for (const std::string& isa : usable_isas()) {
      const Picture got = library_picture(description, isa);
      const Comparison comparison = compare(wanted, got, tolerance);
      INFO("random scene " << seed << ", " << isa << ": worst difference " << comparison.worst);
      if (comparison.differing > most_differing * static_cast<double>(wanted.pixels.size())) {
        const std::string name = "random-scene-" + std::to_string(seed) + "-" + isa;
        const std::string evidence = save_evidence(name, wanted, got, comparison);
        std::ofstream(std::filesystem::path("failed-pictures") / (name + ".xml")) << text;
        FAIL_CHECK(evidence);
      }
    }
  }
}

void check_scenes(unsigned first, unsigned last) {
  check_scenes(first, last, [](reference::Scene&) {}, [](SceneDescription&) {});
}

/// Moves all that the scene has.
void move(SceneDescription& description, const Vec3d& by) {
  const auto move_items = [&]<class Type>(std::type_identity<Type>, auto& items) {
    for (auto& item : items)
      for (const Field& point : point_fields<Type>()) point.get<Vec3d>(&item.parameters) += by;
  };
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape> type) {
    move_items(type, std::get<ObjectItems<Shape>>(description.objects));
  });
  for_each_type(Lights{}, [&]<class Light>(std::type_identity<Light> type) {
    move_items(type, std::get<LightItems<Light>>(description.lights));
  });
  for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
    if (auto* camera = std::get_if<typename Camera::Parameters>(&description.camera))
      for (const Field& point : point_fields<Camera>()) point.get<Vec3d>(camera) += by;
  });
}

}  // namespace

TEST_CASE("random scenes 0 to 11 equal the reference's pictures") { check_scenes(0, 12); }
TEST_CASE("random scenes 12 to 23 equal the reference's pictures") { check_scenes(12, 24); }
TEST_CASE("random scenes 24 to 35 equal the reference's pictures") { check_scenes(24, 36); }
TEST_CASE("random scenes 36 to 47 equal the reference's pictures") { check_scenes(36, 48); }

TEST_CASE("random scenes far from the origin equal the reference's pictures of those near it") {
  check_scenes(
      0, 24, [](reference::Scene&) {}, [](SceneDescription& description) { move(description, {1e7, -3e6, 2e7}); });
}

TEST_CASE("random scenes from a camera far away equal the reference's pictures") {
  const auto go_away = [](reference::Scene& scene) {
    const reference::Vector way = scene.eye - scene.look_at;
    const reference::Real nearer = length(way) / 1e7L, height = scene.pixel_size / scene.view_distance;
    scene.eye = scene.look_at + (1 / nearer) * way;
    scene.pixel_size = height * nearer * scene.view_distance;
  };
  check_scenes(0, 24, go_away, [](SceneDescription&) {});
}

TEST_CASE("random scenes of transformed objects, meshes and instances equal the reference's pictures") {
  check_scenes(0, 24, reference::transform_objects, [](SceneDescription&) {});
}

TEST_CASE("random scenes in motion equal the reference's pictures") {
  const auto move = [](reference::Scene& scene, unsigned seed) {
    set_in_motion(scene, seed);
    set_time(scene);
  };
  check_scenes(0, 8, move, [](SceneDescription&) {});
  const auto move_other_cameras = [](reference::Scene& scene, unsigned seed) {
    change_camera(scene, seed);
    set_in_motion(scene, seed);
    set_time(scene);
  };
  check_scenes(0, 6, move_other_cameras, [](SceneDescription&) {});
}

TEST_CASE("random scenes through other cameras equal the reference's pictures") {
  check_scenes(0, 24, change_camera, [](SceneDescription&) {});
}

TEST_CASE("random scenes through other cameras, far away or far from the origin, equal the reference's pictures") {
  const auto go_away = [](reference::Scene& scene, unsigned seed) {
    change_camera(scene, seed);
    // All around, things far away would be smaller than pixels.
    if (scene.projection == reference::Scene::Projection::spherical) return;
    const reference::Vector way = scene.eye - scene.look_at;
    const reference::Real farther = 1e5L;
    scene.eye = scene.look_at + farther * way;
    scene.pixel_size = scene.pixel_size / farther;
    scene.focal_distance = farther * scene.focal_distance;
    scene.angle = static_cast<float>(100 / farther);
  };
  check_scenes(0, 12, go_away, [](SceneDescription&) {});
  check_scenes(0, 12, change_camera, [](SceneDescription& description) { move(description, {1e7, -3e6, 2e7}); });
}

TEST_CASE("random scenes of which the camera does not see all equal the reference's pictures") {
  const auto hide = [](reference::Scene& scene, unsigned seed) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) scene.objects[i].visible = (i + seed) % 3 != 0;
    const bool has_plane = scene.projection == reference::Scene::Projection::pinhole ||
                           scene.projection == reference::Scene::Projection::thin_lens;
    // Before the middle, in it, or not at all.
    if (has_plane) scene.near_clip = static_cast<float>((seed / 2 % 3) * 0.45L * length(scene.eye - scene.look_at));
  };
  check_scenes(0, 18, hide, [](SceneDescription&) {});
  const auto transform = [&](reference::Scene& scene, unsigned seed) {
    reference::transform_objects(scene, seed);
    hide(scene, seed);
  };
  check_scenes(0, 12, transform, [](SceneDescription&) {});
  const auto move = [&](reference::Scene& scene, unsigned seed) {
    hide(scene, seed);
    set_in_motion(scene, seed);
    set_time(scene);
  };
  check_scenes(0, 8, move, [](SceneDescription&) {});
  const auto change = [&](reference::Scene& scene, unsigned seed) {
    change_camera(scene, seed);
    hide(scene, seed);
  };
  check_scenes(0, 12, change, [](SceneDescription&) {});
  const auto go_away = [&](reference::Scene& scene, unsigned seed) {
    const reference::Vector way = scene.eye - scene.look_at;
    scene.eye = scene.look_at + 1e5L * way;
    scene.pixel_size = scene.pixel_size / 1e5L;
    hide(scene, seed);
    if (scene.near_clip > 0) scene.near_clip = length(scene.eye - scene.look_at) - (seed % 2) * length(way) / 4;
  };
  check_scenes(0, 12, go_away, [](SceneDescription&) {});
}

TEST_CASE("the random scenes show every kind of thing") {
  // What the comparison above is worth depends on this: something is hit, lit, shadowed and seen from inside.
  int covered = 0, shadowed = 0;
  std::vector<std::string> elements;
  for (unsigned seed = 0; seed < 48; ++seed) {
    reference::Scene scene = reference::random_scene(seed);
    scene.hres = 16;
    scene.vres = 12;
    scene.pixel_size = 10 * scene.pixel_size;
    const std::vector<reference::Vector> with_shadows = reference::render(scene);
    int hits = 0;
    for (int row = 0; row < scene.vres; ++row) {
      for (int column = 0; column < scene.hres; ++column) {
        const auto hit = reference::nearest_hit(scene, reference::camera_ray(scene, column, row, 0.5L, 0.5L));
        hits += hit.has_value();
        if (hit) elements.push_back(scene.objects[hit->object].shape->element());
      }
    }
    covered += hits > 16 * 12 / 20;
    for (reference::Light& light : scene.lights) light.shadows = false;
    const std::vector<reference::Vector> without = reference::render(scene);
    int darker = 0;
    for (std::size_t i = 0; i < without.size(); ++i) darker += difference(without[i], with_shadows[i]) > 0.01;
    shadowed += darker > 3;
  }
  CHECK(covered >= 44);
  CHECK(shadowed >= 20);
  for (const char* element :
       {"plane", "sphere", "triangle", "cylinder", "torus", "disk", "rectangle", "box", "cone", "annulus"}) {
    INFO(element);
    CHECK(std::count(elements.begin(), elements.end(), element) >
          30);  // compilers draw the numbers in orders of their own
  }
}

}  // namespace raytrace::test
