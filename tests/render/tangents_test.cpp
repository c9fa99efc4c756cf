// Tangents of materials whose reflection differs along the surface: turned, or of a map, they are those of texture
// coordinates that are turned.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Of a square's corners; u is to the right, or to the left where it is mirrored, both turned by that angle.
std::string square_uvs(double degrees, bool mirrored = false) {
  const double s = std::sin(radians(degrees)), c = std::cos(radians(degrees));
  std::string text;
  for (const auto& [x, y] : std::array<std::array<double, 2>, 4>{{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}}) {
    const double u = mirrored ? -x : x;
    text += (text.empty() ? "" : ", ") + std::to_string(c * u + s * y) + " " + std::to_string(c * y - s * u);
  }
  return text;
}

/// A brushed square before a light. The texture t has one colour.
struct BrushedScene {
  std::string uvs = square_uvs(0), more_of_mesh{}, more{};
  std::array<double, 2> red_green{0.5, 0.5};
  std::string more_of_texture{}, integrator = "<raycast/>", eye = "<eye x='0' y='0' z='9'/>";
  bool is_conductor = false;

  FloatPicture picture() const {
    const std::string color =
        " red='" + std::to_string(red_green[0]) + "' green='" + std::to_string(red_green[1]) + "' blue='1'/>";
    const std::string material =
        is_conductor
            ? "<conductors><conductor><name>m</name><cr red='0.9' green='0.8' blue='0.7'/><roughness>0.4</roughness>"
              "<anisotropy>0.8</anisotropy>" +
                  more + "</conductor></conductors>"
            : "<openpbrs><openpbr><name>m</name><base_metalness>1</base_metalness><specular_roughness>0.4"
              "</specular_roughness><specular_roughness_anisotropy>0.8</specular_roughness_anisotropy>" +
                  more + "</openpbr></openpbrs>";
    return rendered(
        "<raytracer><viewplane><hres>24</hres><vres>18</vres><samples>4</samples></viewplane><camera>" + eye +
        "<lookat x='0' y='0' z='0'/><viewdistance>24</viewdistance></camera><integrator>" + integrator +
        "</integrator><lights><pointlights><pointlight><location x='1' y='2' z='5'/></pointlight>"
        "<pointlight><location x='1' y='2' z='-5'/></pointlight></pointlights></lights>"
        "<textures><checkers><checker><name>t</name><color1" +
        color + "<color2" + color + more_of_texture + "</checker></checkers></textures><materials>" + material +
        "</materials><objects><meshes><mesh><positions>-3 -3 0, 3 -3 0, 3 3 0, -3 3 0</positions>"
        "<faces>0 1 2 3,</faces><uvs>" +
        uvs + "</uvs>" + more_of_mesh + "<material>m</material></mesh></meshes></objects></raytracer>");
  }
};

/// The largest difference, over the brightest pixel.
double brushed_difference(const FloatPicture& a, const FloatPicture& b) {
  double worst = 0, brightest = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    worst = std::max(worst, difference(a.pixels()[i], b.pixels()[i]));
    brightest = std::max(brightest, double{a.pixels()[i].red});
  }
  REQUIRE(brightest > 0.1);
  return worst / brightest;
}

std::string tangentrotation(double degrees) {
  return "<tangentrotation>" + std::to_string(degrees) + "</tangentrotation>";
}

}  // namespace

TEST_CASE("a turned tangent is that of turned texture coordinates") {
  for (const bool is_conductor : {false, true})
    for (const bool mirrored : {false, true})
      for (const char* const eye : {"<eye x='0' y='0' z='9'/>", "<eye x='1' y='0.5' z='-9'/>"}) {
        BrushedScene scene;
        scene.is_conductor = is_conductor;
        scene.eye = eye;
        scene.uvs = square_uvs(0, mirrored);
        const FloatPicture plain = scene.picture();
        for (const double degrees : {30.0, 90.0, -400.0}) {
          INFO(is_conductor << " " << mirrored << " " << eye << " " << degrees);
          scene.uvs = square_uvs(degrees, mirrored);
          scene.more = "";
          const FloatPicture wanted = scene.picture();
          scene.uvs = square_uvs(0, mirrored);
          scene.more = tangentrotation(degrees);
          CHECK(brushed_difference(wanted, scene.picture()) < 1e-3);
          CHECK(brushed_difference(wanted, plain) > 0.1);
        }
      }
}

TEST_CASE("a map of tangents, and a texture of a turn") {
  BrushedScene turned;
  turned.uvs = square_uvs(50);
  const FloatPicture wanted = turned.picture();
  BrushedScene scene;
  const double s = std::sin(radians(50)), c = std::cos(radians(50));
  scene.red_green = {0.5 + 0.5 * c, 0.5 + 0.5 * s};
  scene.more = "<tangentmap texture='t'/>";
  CHECK(brushed_difference(wanted, scene.picture()) < 1e-3);
  scene.red_green = {0.5 + 0.1 * c, 0.5 + 0.1 * s};  // of any length
  CHECK(brushed_difference(wanted, scene.picture()) < 1e-3);
  scene.red_green = {0.5 + 0.5 * std::cos(radians(20)), 0.5 + 0.5 * std::sin(radians(20))};
  scene.more = "<tangentmap texture='t'/>" + tangentrotation(30);
  CHECK(brushed_difference(wanted, scene.picture()) < 1e-3);
  scene.red_green = {0.25, 0.5};
  scene.more = "<tangentrotation texture='t'>200</tangentrotation>";
  CHECK(brushed_difference(wanted, scene.picture()) < 1e-3);

  // No direction is along u.
  scene.red_green = {128 / 255.0, 128 / 255.0};
  scene.more = "<tangentmap texture='t'/>";
  CHECK(brushed_difference(BrushedScene().picture(), scene.picture()) < 1e-3);
}

TEST_CASE("the tangent is along u of the texture coordinates of its map, or of the normals'") {
  BrushedScene by_first;
  by_first.uvs = square_uvs(50);
  const FloatPicture wanted = by_first.picture();
  BrushedScene scene;
  scene.more_of_mesh = "<uvs2>" + square_uvs(50) + "</uvs2>";
  scene.more_of_texture = "<uvset>2</uvset>";
  scene.red_green = {1, 0.5};
  scene.more = "<tangentmap texture='t'/>";
  CHECK(brushed_difference(wanted, scene.picture()) < 1e-3);
  scene.red_green = {0.5, 0.5};
  scene.more = "<normalmap texture='t'/>";
  CHECK(brushed_difference(wanted, scene.picture()) < 1e-3);
  scene.more_of_texture = "";
  CHECK(brushed_difference(BrushedScene().picture(), scene.picture()) < 1e-3);
}

TEST_CASE("paths by turned tangents do not depend on threads, samples at once, or cuts") {
  check_same_bits_of_balls(
      "<conductors><conductor><name>gold</name><metal>gold</metal><roughness>0.3</roughness><anisotropy>0.7</"
      "anisotropy>"
      "<tangentrotation texture='checks'>70</tangentrotation></conductor></conductors><openpbrs><openpbr><name>steel"
      "</name><base_metalness>1</base_metalness><specular_roughness_anisotropy>0.8</specular_roughness_anisotropy>"
      "<tangentmap texture='checks'/></openpbr></openpbrs>",
      {"gold", "steel"}, "<color1 red='1' green='0.4' blue='1'/><color2 red='0.3' green='0.6' blue='0.2'/>");
}

}  // namespace raytrace::test
