// Pictures whose every value is known on paper.
#include <cmath>

#include "pictures/comparison.h"
#include "raytrace/render/renderer.h"
#include "reference/renderer.h"
#include "reference/scene.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

using reference::Light;
using reference::Material;
using reference::Scene;
using reference::Vector;

/// A camera at (0, 0, 10) that looks down -z on the plane z = 0, an odd number of pixels across; its middle pixel sees
/// (0, 0, 0).
Scene facing_a_plane(const Material& material) {
  Scene scene;
  scene.hres = scene.vres = 21;
  scene.eye = {0, 0, 10};
  scene.view_distance = 10;
  scene.pixel_size = 0.25L;
  scene.background = {0.25L, 0.5L, 0.75L};
  scene.materials.push_back(material);
  scene.objects.push_back({std::make_shared<reference::Plane>(Vector{0, 0, 0}, Vector{0, 0, 1}), 0});
  return scene;
}

Material matte(double ka, double kd, Vector cd) {
  Material material;
  material.name = "m";
  material.ka = ka;
  material.kd = kd;
  material.cd = cd;
  return material;
}

Light directional(Vector direction, double scale, Vector color = {1, 1, 1}) {
  Light light;
  light.kind = Light::Kind::directional;
  light.place = direction;
  light.scale = scale;
  light.color = color;
  return light;
}

Light point(Vector location, double scale) {
  Light light;
  light.place = location;
  light.scale = scale;
  return light;
}

std::vector<Picture> pictures_of(const Scene& scene) {
  const SceneDescription description = parsed_scene(reference::scene_text(scene));
  std::vector<Picture> pictures;
  for (const std::string& isa : usable_isas()) pictures.push_back(library_picture(description, isa));
  return pictures;
}

void check_pixel(const Picture& picture, int x, int y, Vector wanted) {
  const Vector got = picture.at(x, y);
  INFO("pixel (" << x << ", " << y << ")");
  CHECK(static_cast<double>(got.x) == Approx(static_cast<double>(wanted.x)).epsilon(1e-5).margin(1e-7));
  CHECK(static_cast<double>(got.y) == Approx(static_cast<double>(wanted.y)).epsilon(1e-5).margin(1e-7));
  CHECK(static_cast<double>(got.z) == Approx(static_cast<double>(wanted.z)).epsilon(1e-5).margin(1e-7));
}

}  // namespace

TEST_CASE("an empty scene is all background") {
  Scene scene = facing_a_plane(matte(1, 1, {1, 1, 1}));
  scene.objects.clear();
  for (const Picture& picture : pictures_of(scene)) {
    for (const int i : {0, 10, 20}) check_pixel(picture, i, i, scene.background);
  }
}

TEST_CASE("ambient light alone is ka cd La") {
  Scene scene = facing_a_plane(matte(0.5, 1, {0.2L, 0.4L, 0.8L}));
  scene.has_ambient = true;
  scene.ambient_scale = 3;
  scene.ambient_color = {1, 0.5L, 0.25L};
  for (const Picture& picture : pictures_of(scene)) check_pixel(picture, 3, 17, {0.3L, 0.3L, 0.3L});
}

TEST_CASE("without an ambient light and other lights everything hit is black") {
  for (const Picture& picture : pictures_of(facing_a_plane(matte(1, 1, {1, 1, 1}))))
    check_pixel(picture, 10, 10, {0, 0, 0});
}

TEST_CASE("directional light on a matte plane is kd cd / pi Ls cos") {
  Scene scene = facing_a_plane(matte(0, 0.75, {1, 0.5L, 0}));
  scene.lights.push_back(directional({3, 0, 4}, 2, {1, 1, 0.5L}));  // cos = 4/5
  const reference::Real value = 0.75L / reference::pi * 2 * 0.8L;
  for (const Picture& picture : pictures_of(scene)) check_pixel(picture, 2, 5, {value, value / 2, 0});
}

TEST_CASE("a point light does not fall off with distance") {
  Scene scene = facing_a_plane(matte(0, 1, {1, 1, 1}));
  scene.lights.push_back(point({3, 4, 12}, 2));  // 13 from the middle, cos = 12/13
  for (const Picture& picture : pictures_of(scene)) {
    const reference::Real middle = 2 / reference::pi * 12 / 13;
    check_pixel(picture, 10, 10, {middle, middle, middle});
    // Column 14 from the left is 4 pixels right of the middle, (1, 0, 0); row 6 from the top is (0, 1, 0).
    const reference::Real right = 2 / reference::pi * 12 / std::sqrt(4.0L + 16 + 144);
    check_pixel(picture, 14, 10, {right, right, right});
    const reference::Real up = 2 / reference::pi * 12 / std::sqrt(9.0L + 9 + 144);
    check_pixel(picture, 10, 6, {up, up, up});
  }
}

TEST_CASE("Phong at the mirror direction adds ks cs Ls cos, and less beside it") {
  Material material = matte(0, 0, {1, 1, 1});
  material.phong = true;
  material.ks = 0.5;
  material.cs = {1, 0.5L, 0.25L};
  material.exponent = 10;
  Scene scene = facing_a_plane(material);
  scene.lights.push_back(directional({0, 0, 1}, 2));  // straight back to the eye
  for (const Picture& picture : pictures_of(scene)) {
    check_pixel(picture, 10, 10, {1, 0.5L, 0.25L});
    // (1, 0, 0) seen from (0, 0, 10): the mirrored light is +z, and r.wo = 10 / sqrt(101).
    const reference::Real beside = std::pow(10 / std::sqrt(101.0L), 10.0L);
    check_pixel(picture, 14, 10, {beside, beside / 2, beside / 4});
  }
}

TEST_CASE("Phong has no highlight where the mirror direction points away from the viewer") {
  Material material = matte(0, 0, {1, 1, 1});
  material.phong = true;
  material.ks = 1;
  material.cs = {1, 1, 1};
  material.exponent = 2;  // even: (r.wo)^exp alone would be positive
  Scene scene = facing_a_plane(material);
  scene.eye = {10, 0, 1};  // grazing, with the light behind it
  scene.lights.push_back(directional({10, 0, 1}, 1));
  for (const Picture& picture : pictures_of(scene)) check_pixel(picture, 10, 10, {0, 0, 0});
}

TEST_CASE("an object between casts a shadow, unless the light casts none") {
  Scene scene = facing_a_plane(matte(0, 1, {1, 1, 1}));
  scene.objects.push_back(
      {std::make_shared<reference::Sphere>(Vector{3, 0, 3}, 0.5L), 0});  // beside the view, before the light
  scene.lights.push_back(point({6, 0, 6}, 1));
  for (const Picture& picture : pictures_of(scene)) check_pixel(picture, 10, 10, {0, 0, 0});
  scene.lights[0].shadows = false;
  const reference::Real lit = std::sqrt(0.5L) / reference::pi;
  for (const Picture& picture : pictures_of(scene)) check_pixel(picture, 10, 10, {lit, lit, lit});
}

TEST_CASE("an object behind a point light casts no shadow") {
  Scene scene = facing_a_plane(matte(0, 1, {1, 1, 1}));
  scene.objects.push_back({std::make_shared<reference::Sphere>(Vector{9, 0, 9}, 0.5L), 0});
  scene.lights.push_back(point({6, 0, 6}, 1));
  const reference::Real lit = std::sqrt(0.5L) / reference::pi;
  for (const Picture& picture : pictures_of(scene)) check_pixel(picture, 10, 10, {lit, lit, lit});
}

TEST_CASE("open surfaces are lit on the side that is seen") {
  for (const reference::Real turn : {1.0L, -1.0L}) {
    Scene scene = facing_a_plane(matte(0, 1, {1, 1, 1}));
    scene.objects[0].shape = std::make_shared<reference::Plane>(Vector{0, 0, 0}, Vector{0, 0, turn});
    scene.lights.push_back(directional({0, 0, 1}, 1));
    const reference::Real lit = 1 / reference::pi;
    for (const Picture& picture : pictures_of(scene)) check_pixel(picture, 10, 10, {lit, lit, lit});
    scene.lights[0].place = {0, 0, -1};  // behind
    scene.lights[0].shadows = false;
    for (const Picture& picture : pictures_of(scene)) check_pixel(picture, 10, 10, {0, 0, 0});
  }
}

TEST_CASE("with an up vector along the view the picture is that of another up") {
  Scene scene = reference::random_scene(3);
  scene.eye = scene.look_at + Vector{0, 5, 0};
  scene.up = {0, -2, 0};
  const SceneDescription description = parsed_scene(reference::scene_text(scene));
  const CameraMatrices matrices = camera_matrices(description);
  const auto& world_to_camera = matrices.world_to_camera;
  // Which up was chosen is the library's to say: the second column of world-to-camera.
  scene.up = {world_to_camera[1], world_to_camera[5], world_to_camera[9]};
  const Picture wanted = reference_picture(scene);
  for (const std::string& isa : usable_isas()) {
    const Picture got = library_picture(description, isa);
    const Comparison comparison = compare(wanted, got, 1e-3);
    if (comparison.differing > 38) FAIL_CHECK(save_evidence("up-along-view-" + isa, wanted, got, comparison));
  }
}

TEST_CASE("a pixel's mean over many samples converges to the integral over its square") {
  Scene scene = reference::random_scene(5);
  scene.hres = 12;
  scene.vres = 9;
  scene.pixel_size = 160.0L / 12 * scene.pixel_size;
  Picture wanted{scene.hres, scene.vres, {}};
  for (int y = 0; y < scene.vres; ++y) {
    for (int x = 0; x < scene.hres; ++x) wanted.pixels.push_back(reference::supersampled_pixel(scene, x, y, 48));
  }
  const auto mean_difference = [&](int samples, const std::string& isa) {
    scene.samples = samples;
    const Picture got = library_picture(parsed_scene(reference::scene_text(scene)), isa);
    double sum = 0;
    for (std::size_t i = 0; i < wanted.pixels.size(); ++i) sum += difference(wanted.pixels[i], got.pixels[i]);
    return sum / static_cast<double>(wanted.pixels.size());
  };
  for (const std::string& isa : usable_isas()) {
    INFO(isa);
    const double at_4 = mean_difference(4, isa), at_64 = mean_difference(64, isa), at_1024 = mean_difference(1024, isa);
    INFO("mean differences " << at_4 << ", " << at_64 << ", " << at_1024);
    CHECK(at_64 < at_4 / 3);
    CHECK(at_1024 < at_64 / 2);
    CHECK(at_1024 < 2e-3);
  }
}

}  // namespace raytrace::test
