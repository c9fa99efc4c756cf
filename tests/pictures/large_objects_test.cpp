// A sphere on the ground, whatever the ground is and however large: lit and shadowed as the formulas have it.
#include <cmath>

#include "pictures/comparison.h"
#include "reference/renderer.h"
#include "reference/scene.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

using reference::Real;
using reference::ShapePointer;
using reference::Vector;

/// Ground under (0, 0, 0), whose normal is `up` there.
struct Ground {
  std::string name;
  Vector up;
  ShapePointer shape;
};

Vector in_float(Vector v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// A triangle around (0, 0, 0), across `up`.
Ground triangle_ground(const std::string& name, Vector up, Real half_edge) {
  const Vector x = half_edge * reference::unit(cross(up, Vector{0, 0, 1})), z = cross(x, up);
  return {name, up, std::make_shared<reference::Triangle>(in_float(z - x), in_float(x + z), in_float(-z))};
}

Ground planet(const std::string& name, Real radius) {
  return {name, {0, 1, 0}, std::make_shared<reference::Sphere>(Vector{0, -radius, 0}, radius)};
}

/// All sizes and distances but the ground's in multiples of `scale`.
reference::Scene scene_on(const Ground& ground, Real scale) {
  reference::Scene scene;
  scene.hres = 96;
  scene.vres = 64;
  const Vector right = reference::unit(cross(ground.up, Vector{0, 0, 1})), back = cross(right, ground.up);
  const auto at = [&](Real x, Real y, Real z) { return in_float(scale * (x * right + y * ground.up + z * back)); };
  scene.eye = at(0, 3, 8);
  scene.look_at = at(0, 0.7L, 0);
  scene.up = in_float(ground.up);
  scene.view_distance = 110;
  scene.has_ambient = true;
  reference::Light light;
  light.place = at(4, 6, 5);
  light.scale = 3;
  scene.lights.push_back(light);
  reference::Material material;
  material.name = "m";
  material.ka = 0.125L;
  material.kd = 0.75L;
  material.cd = {1, 1, 1};
  scene.materials.push_back(material);
  scene.objects.push_back({ground.shape, 0});
  scene.objects.push_back({std::make_shared<reference::Sphere>(at(0, 1, 0), static_cast<float>(scale)), 0});
  return scene;
}

void check_ground(const Ground& ground, Real scale) {
  const reference::Scene scene = scene_on(ground, scale);
  const SceneDescription description = parsed_scene(reference::scene_text(scene));
  const Picture wanted = reference_picture(scene);
  for (const std::string& isa : usable_isas()) {
    const Picture got = library_picture(description, isa);
    const Comparison comparison = compare(wanted, got, 1e-3);
    INFO(ground.name << ", " << isa << ": worst difference " << comparison.worst << ", " << comparison.differing
                     << " pixels differ");
    if (comparison.differing > 12) FAIL_CHECK(save_evidence("ground-" + ground.name, wanted, got, comparison));
  }
}

const Vector tilted = reference::unit(Vector{0.3L, 1, 0.2L});

}  // namespace

TEST_CASE("a unit sphere on a planet is lit and casts its shadow") {
  check_ground(planet("planet of 1e4", 1e4L), 1);
  check_ground(planet("planet of 6371000", 6371000), 1);
  check_ground(planet("planet of 1e9", 1e9L), 1);
}

TEST_CASE("a unit sphere on a huge triangle is lit and casts its shadow") {
  check_ground(triangle_ground("triangle of 1e4", {0, 1, 0}, 1e4L), 1);
  check_ground(triangle_ground("triangle of 1e6", {0, 1, 0}, 1e6L), 1);
  check_ground(triangle_ground("triangle of 3e9", {0, 1, 0}, 3e9L), 1);
  check_ground(triangle_ground("triangle of 1e12", {0, 1, 0}, 1e12L), 1);
  check_ground(triangle_ground("tilted triangle of 1e4", tilted, 1e4L), 1);
}

TEST_CASE("a tiny sphere on a tiny triangle is lit and casts its shadow") {
  for (const Real scale : {1e-6L, 1e-9L, 1e-12L}) {
    const auto exact = static_cast<Real>(static_cast<float>(scale));
    check_ground(triangle_ground("triangle of 30 times " + std::to_string(std::log10(scale)), {0, 1, 0}, 30 * exact),
                 exact);
    check_ground(
        triangle_ground("tilted triangle of 30 times " + std::to_string(std::log10(scale)), tilted, 30 * exact), exact);
  }
}

}  // namespace raytrace::test
