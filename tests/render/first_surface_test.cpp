// The integrators that look at models: ambient occlusion, texture coordinates and albedo.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// A floor, and what else there is; the camera looks down at the origin from `height`, at a small part of it.
std::string above_floor(const std::string& integrator, const std::string& objects, double height = 0.5) {
  return "<raytracer><integrator>" + integrator +
         "</integrator><viewplane><hres>8</hres><vres>8</vres><samples>256</samples></viewplane><camera>" +
         vector_text("eye", 0, height, 1e-4) +
         "<lookat x='0' y='0' z='0'/><fov>0.01</fov></camera><materials><mattes><matte><name>m</name><ka>0</ka>"
         "<kd>0.5</kd><cd red='1' green='0.5' blue='0.25'/></matte></mattes></materials><objects><planes><plane>"
         "<point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>m</material></plane></planes>" +
         objects + "</objects></raytracer>";
}

double mean_white(const std::string& text) { return mean_green(rendered(text)); }

const std::string roof_disk =
    "<disks><disk><center x='0' y='1' z='0'/><normal x='0' y='1' z='0'/><radius>0.75</radius><material>m</material>"
    "</disk></disks>";

}  // namespace

TEST_CASE("an open floor is white by ambient occlusion, and the inside of a sphere black") {
  CHECK(mean_white(above_floor("<ambientocclusion/>", "")) == 1);
  const std::string sphere =
      "<spheres><sphere><center x='0' y='0' z='0'/><radius>9</radius><material>m</material></sphere></spheres>";
  CHECK(mean_white(above_floor("<ambientocclusion/>", sphere)) == 0);
}

TEST_CASE("a disk overhead hides the square of the sine of its angle, and nothing beyond the distance") {
  CHECK(std::abs(mean_white(above_floor("<ambientocclusion/>", roof_disk)) - (1 - 0.36)) < 0.005);
  CHECK(mean_white(above_floor("<ambientocclusion><distance>0.99</distance></ambientocclusion>", roof_disk)) == 1);
  // Its inner part alone, from where it is 1 away to where it is 1.1.
  const double inner =
      mean_white(above_floor("<ambientocclusion><distance>1.1</distance></ambientocclusion>", roof_disk));
  CHECK(std::abs(inner - 1 / (1.1 * 1.1)) < 0.005);
}

TEST_CASE("albedo is what the material reflects, without light") {
  for (const std::string& isa : usable_isas()) {
    const Pixel pixel = rendered(parsed_scene(above_floor("<albedo/>", "")), 1, isa).at(3, 3);
    CHECK(std::abs(pixel.red - 0.5F) < 1e-6F);
    CHECK(std::abs(pixel.green - 0.25F) < 1e-6F);
    CHECK(std::abs(pixel.blue - 0.125F) < 1e-6F);
  }
}

TEST_CASE("texture coordinates are red and green") {
  const std::string rectangle =
      "<rectangles><rectangle><corner x='-1' y='0.1' z='1'/><edge1 x='4' y='0' z='0'/><edge2 x='0' y='0' z='-4'/>"
      "<material>m</material></rectangle></rectangles>";
  for (const std::string& isa : usable_isas()) {
    const Pixel pixel = rendered(parsed_scene(above_floor("<uv/>", rectangle)), 1, isa).at(3, 3);
    CHECK(std::abs(pixel.red - 0.25F) < 1e-3F);
    CHECK(std::abs(pixel.green - 0.25F) < 1e-3F);
    CHECK(pixel.blue == 0);
  }
}

TEST_CASE("looking at models gives the same bits however it is cut") {
  const std::string integrator = GENERATE("ambientocclusion", "uv", "albedo", "normals");
  INFO(integrator);
  std::string text = busy_scene(40, 30, 16);
  const SceneDescription description =
      parsed_scene(text.insert(text.find("<raytracer>") + 11, "<integrator><" + integrator + "/></integrator>"));
  check_same_bits(description);
}

}  // namespace raytrace::test
