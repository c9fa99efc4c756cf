// Coats and the bases below them, each with its own relief.
#include <cmath>
#include <numbers>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

/// A normal map of one direction: so much along u, in degrees.
std::string even_map(const std::string& name, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const std::string color = " red='" + std::to_string(0.5 + std::sin(angle) / 2) + "' green='0.5' blue='" +
                            std::to_string(0.5 + std::cos(angle) / 2) + "'/>";
  return "<checker><name>" + name + "</name><color1" + color + "<color2" + color + "</checker>";
}

const std::string clear_coat = "<coat_weight>1</coat_weight>";
const std::string black_base = clear_coat + "<base_weight>0</base_weight><specular_weight>0</specular_weight>";

/// A panel from straight above, in the light of a small lamp that a ray straight down meets if it is mirrored about a
/// normal that leans so many degrees along u.
std::string coated_panel(const std::string& material, double lamp_degrees, const std::string& integrator) {
  const double angle = 2 * lamp_degrees * std::numbers::pi / 180;
  const std::string at =
      "x='" + std::to_string(10 * std::sin(angle)) + "' y='0' z='" + std::to_string(10 * std::cos(angle)) + "'";
  return "<raytracer><viewplane><hres>8</hres><vres>8</vres><pixelsize>0.01</pixelsize><samples>16</samples>"
         "</viewplane><orthographiccamera><eye x='0.2' y='0.1' z='5'/><lookat x='0.2' y='0.1' z='0'/>"
         "</orthographiccamera><integrator>" +
         integrator + "</integrator><lights><directionallights><directionallight><direction " + at +
         "/><shadows>false</shadows></directionallight></directionallights></lights><textures><checkers>" +
         even_map("leaning", 25) + even_map("little", 10) +
         "</checkers></textures><materials><openpbrs><openpbr><name>m</name>" + material +
         "</openpbr></openpbrs><emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/>"
         "<scaleradiance>50</scaleradiance></emissive></emissives></materials><objects><rectangles><rectangle>"
         "<corner x='-1' y='-1' z='0'/><edge1 x='2' y='0' z='0'/><edge2 x='0' y='2' z='0'/><material>m</material>"
         "</rectangle></rectangles><spheres><sphere><center " +
         at + "/><radius>0.6</radius><material>lamp</material></sphere></spheres></objects></raytracer>";
}

double green_of(const std::string& material, double lamp_degrees, const std::string& integrator) {
  return mean_green(rendered(coated_panel(material, lamp_degrees, integrator)));
}

}  // namespace

TEST_CASE("a coat shows a lamp where the smooth surface does, whatever relief is below it") {
  const std::string path = "<path><maxdepth>3</maxdepth></path>";
  for (const std::string integrator : {"<raycast/>", path.c_str()})
    for (const std::string roughness : {"0", "0.3"}) {
      if (integrator == "<raycast/>" && roughness == "0") continue;  // shows no lamps in mirrors
      INFO(integrator << ", roughness " << roughness);
      const std::string coat = black_base + "<coat_roughness>" + roughness + "</coat_roughness>";
      const std::string relief = "<normalmap texture='leaning'/>";
      const double smooth = green_of(coat, 20, integrator);
      CHECK(green_of(coat + relief, 20, integrator) == Approx(smooth).margin(1e-4));
      const double straight = green_of(coat, 1, integrator);
      CHECK(green_of(coat + relief, 1, integrator) == Approx(straight).epsilon(1e-3));
      CHECK(straight > 0.01);
    }
}

TEST_CASE("a coat with a normal map shows a lamp where the map leans, and so does its base") {
  const std::string path = "<path><maxdepth>3</maxdepth></path>";
  const std::string coat = black_base + "<coat_roughness>0.2</coat_roughness>";
  const std::string map = "<coatnormalmap texture='little'/>";
  CHECK(green_of(coat + map, 10, path) > 20 * green_of(coat, 10, path));
  CHECK(green_of(coat + map, 0, path) < 0.05 * green_of(coat, 0, path));
  CHECK(green_of(coat + "<coatnormalmap texture='little' strength='0.5'/>", 5, path) > 10 * green_of(coat, 5, path));
  const std::string metal =
      clear_coat + "<base_metalness>1</base_metalness><specular_roughness>0.2</specular_roughness>";
  CHECK(green_of(metal + "<normalmap texture='leaning'/>" + map, 25, path) > 20 * green_of(metal, 25, path));
}

TEST_CASE("a diffuse base under a coat gets the light of its own normal map") {
  const std::string base =
      "<specular_weight>0</specular_weight><coat_ior>1</coat_ior><coat_darkening>0</coat_darkening>"
      "<normalmap texture='leaning'/>";
  for (const std::string integrator : {"<raycast/>", "<path/>"})
    for (const double degrees : {25.0, 42.0}) {  // of the lamp; grazing light ends softly on relief
      INFO(integrator << ", " << degrees);
      // A coat of index 1 is not there.
      const double bare = green_of(base, degrees, integrator);
      CHECK(green_of(base + clear_coat, degrees, integrator) == Approx(bare).epsilon(2e-3));
      CHECK(green_of(base + clear_coat + "<coatnormalmap texture='little'/>", degrees, integrator) ==
            Approx(bare).epsilon(2e-3));
    }
}

TEST_CASE("the normals of a coated material are its base's") {
  const std::string leaning = "<normalmap texture='leaning'/>";
  const FloatPicture coated = rendered(coated_panel(clear_coat + leaning, 40, "<normals/>"));
  CHECK(double{coated.at(3, 3).red} == Approx(0.5 + std::sin(25 * std::numbers::pi / 180) / 2).epsilon(1e-4));
}

TEST_CASE("paths by coats with normals of their own do not depend on threads, samples at once, or cuts") {
  const auto made_of = [](const std::string& name, const std::string& more) {
    return "<openpbr><name>" + name + "</name>" + more + "</openpbr>";
  };
  const std::string coat = "<coat_weight>1</coat_weight><coat_roughness>0.2</coat_roughness>";
  check_same_bits_of_balls(
      "<conductors><conductor><name>gold</name><metal>gold</metal><roughness>0.3</roughness></conductor></conductors>"
      "<openpbrs>" +
          made_of("coated", coat + "<normalmap texture='checks'/>") +
          made_of("both", coat + "<normalmap texture='checks'/><coatnormalmap texture='checks' strength='0.3'/>"
                                 "<fuzz_weight>0.5</fuzz_weight>") +
          made_of("plain", "<normalmap texture='checks'/>") +
          made_of("brushed", coat + "<base_metalness>1</base_metalness><specular_roughness_anisotropy>0.8"
                                    "</specular_roughness_anisotropy><coatnormalmap texture='checks'/>") +
          made_of("glass",
                  "<coat_weight>1</coat_weight><transmission_weight>1</transmission_weight><normalmap "
                  "texture='checks'/>") +
          "</openpbrs>",
      {"coated", "both", "plain", "brushed", "glass", "gold"},
      "<color1 red='0.7' green='0.5' blue='0.9'/><color2 red='0.4' green='0.4' blue='0.9'/>");
}

}  // namespace raytrace::test
