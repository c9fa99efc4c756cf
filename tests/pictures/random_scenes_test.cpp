// The picture equals the formulas of the scene format: random scenes through the whole library, from scene text to
// film, against the reference.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "pictures/comparison.h"
#include "reference/renderer.h"
#include "reference/scene.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// Pixels at silhouettes and shadow edges may fall to either side.
constexpr double tolerance = 1e-3;
constexpr double most_differing = 0.002;

void check_scenes(unsigned first, unsigned last) {
  for (unsigned seed = first; seed < last; ++seed) {
    const reference::Scene scene = reference::random_scene(seed);
    const std::string text = reference::scene_text(scene);
    const SceneDescription description = parsed_scene(text);
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

}  // namespace

TEST_CASE("random scenes 0 to 11 equal the reference's pictures") { check_scenes(0, 12); }
TEST_CASE("random scenes 12 to 23 equal the reference's pictures") { check_scenes(12, 24); }
TEST_CASE("random scenes 24 to 35 equal the reference's pictures") { check_scenes(24, 36); }
TEST_CASE("random scenes 36 to 47 equal the reference's pictures") { check_scenes(36, 48); }

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
  for (const char* element : {"plane", "sphere", "triangle", "cylinder", "torus", "disk", "rectangle"}) {
    INFO(element);
    CHECK(std::count(elements.begin(), elements.end(), element) >
          30);  // compilers draw the numbers in orders of their own
  }
}

}  // namespace raytrace::test
