// The integrator that shows normals.
#include "raytrace/integrators/normals.h"

#include <cmath>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

const std::string sphere =
    "<materials><mattes><matte><name>m</name><ka>0</ka><kd>0</kd><cd red='1' green='1' blue='1'/></matte></mattes>"
    "</materials><objects><spheres><sphere><center x='0' y='2' z='0'/><radius>2</radius><material>m</material></sphere>"
    "</spheres></objects><integrator><normals/></integrator>";

const std::string straight = "<eye x='0' y='2' z='12'/><lookat x='0' y='2' z='0'/>";

}  // namespace

TEST_CASE("a sphere's normals are its colours, from 0 to 1, in the dark too") {
  const SceneDescription description = parsed_scene(scene_text(101, 101, 1, sphere, straight));
  for (const std::string& isa : usable_isas()) {
    const FloatPicture picture = rendered(description, 1, isa);
    int checked = 0;
    double worst = 0;
    for (int y = 0; y < 101; ++y)
      for (int x = 0; x < 101; ++x) {
        // The ray through the pixel's center, from (0, 2, 12) about along -z; the view distance is 101.
        const Vec3d direction = normalize(Vec3d{x + 0.5 - 50.5, 50.5 - (y + 0.5), -101}), to_center{0, 0, -12};
        const double along = dot(direction, to_center);
        const double discriminant = 4 - (dot(to_center, to_center) - along * along);
        const Pixel pixel = picture.at(x, y);
        if (std::abs(discriminant) < 0.02) continue;  // the edge
        Vec3d wanted{0.1, 0.2, 0.4};                  // the background
        if (discriminant > 0) {
          const Vec3d normal = (direction * (along - std::sqrt(discriminant)) - to_center) * 0.5;
          wanted = normal * 0.5 + Vec3d{0.5, 0.5, 0.5};
          ++checked;
        }
        worst = std::max(
            {worst, std::abs(pixel.red - wanted.x), std::abs(pixel.green - wanted.y), std::abs(pixel.blue - wanted.z)});
      }
    INFO(isa);
    CHECK(checked > 500);
    CHECK(worst < 2e-5);
  }
}

TEST_CASE("the normals' film counts on colours up to 1, whatever the lights") {
  const SceneDescription dark = parsed_scene(scene_text(8, 8, 1, sphere));
  CHECK(build_scene(dark, {1, {}})->radiance_range().usual == 1);
  SceneDescription by_light = dark;
  by_light.integrator.reset();
  CHECK(build_scene(by_light, {1, {}})->radiance_range().usual == 0.4F);  // the background's
}

}  // namespace raytrace::test
