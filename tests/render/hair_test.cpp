// Hair on curves: energy, lights on all sides of a fibre, and the same bits however a picture is made.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <algorithm>
#include <cmath>
#include <string>

#include "raytrace/description/clay.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"

namespace raytrace::test {

namespace {

std::string text_of(double value) { return std::to_string(value); }

/// A few bent strands side by side, from `first` on, which taper.
std::string strands(const std::string& material, int count = 9, double radius = 0.05) {
  std::string points;
  for (int i = 0; i < count; ++i) {
    const double x = (i - (count - 1) / 2.0) * 0.16;
    points += (i == 0 ? "" : ", ") + text_of(x) + " -0.9 0  " + text_of(x * 1.2 + 0.1) + " -0.3 0.1  " +
              text_of(x - 0.1) + " 0.3 " + text_of(0.1 * (i % 3)) + "  " + text_of(x * 1.5) + " 0.9 0.2";
  }
  return "<curves><curve><points>" + points + "</points><radius>" + text_of(radius) +
         "</radius><tipscale>0.5</tipscale><material>" + material + "</material></curve></curves>";
}

std::string scene(const std::string& integrator, int size, int samples, const std::string& hair,
                  const std::string& lights, const std::string& more_materials = "",
                  const std::string& more_objects = "", const std::string& background = "") {
  return "<raytracer><integrator>" + integrator + "</integrator><viewplane><hres>" + std::to_string(size) +
         "</hres><vres>" + std::to_string(size) + "</vres><samples>" + std::to_string(samples) + "</samples>" +
         background +
         "</viewplane><camera><eye x='0' y='0.3' z='4'/><lookat x='0' y='0' z='0'/><fov>32</fov></camera>" +
         "<lights>" + lights + "</lights><materials><hairs><hair><name>h</name>" + hair + "</hair></hairs>" +
         more_materials + "</materials><objects>" + strands("h") + more_objects + "</objects></raytracer>";
}

const std::string white = "<color red='1' green='1' blue='1'/>", brown = "<melanin>0.3</melanin>";

std::string roughness(double value) {
  return "<roughness>" + text_of(value) + "</roughness><radialroughness>" + text_of(value) + "</radialroughness>";
}

double worst(const FloatPicture& picture) {
  double worst = 0;
  for (const Pixel& pixel : picture.pixels()) worst = std::max(worst, std::abs(double{pixel.green} - 1));
  return worst;
}

std::string sphere(double x, double y, double z, double radius, const std::string& material) {
  return "<spheres><sphere>" + vector_text("center", x, y, z) + "<radius>" + text_of(radius) + "</radius><material>" +
         material + "</material></sphere></spheres>";
}
std::string lamp(double radiance) {
  return "<emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/><scaleradiance>" + text_of(radiance) +
         "</scaleradiance></emissive></emissives>";
}

}  // namespace

TEST_CASE("white hair cannot be seen under a white sky: no light is lost in it, nor where its pieces join") {
  for (const double rough : {0.1, 0.3, 0.6, 1.0}) {
    const std::string hair = white + roughness(rough);
    INFO("roughness " << rough);
    CHECK(worst(rendered(scene("<path><maxdepth>200</maxdepth><roulettedepth>200</roulettedepth></path>", 16, 16, hair,
                               "", "", "", "<background red='1' green='1' blue='1'/>"))) < 1e-3);
    // Light that is drawn, from all sides: in the mean.
    const FloatPicture lit =
        rendered(scene("<path><maxdepth>200</maxdepth></path>", 16, is_sanitized ? 64 : 400, hair,
                       "<environmentlights><environmentlight><color red='1' green='1' blue='1'/></environmentlight>"
                       "</environmentlights>"));
    CHECK(mean_green(lit) == Approx(1).epsilon(is_sanitized ? 0.02 : 0.004));
  }
}

TEST_CASE("a lamp behind hair shines through: as a point, as a small ball and by raycasting") {
  // The intensity of a ball is its radiance times the area of its disk.
  const double radius = 0.3, radiance = 40, intensity = radiance * 3.14159265 * radius * radius;
  for (const double z : {-4.0, 6.0}) {
    const auto mean = [&](const std::string& integrator, const std::string& lights, const std::string& materials,
                          const std::string& objects) {
      return mean_green(
          rendered(scene(integrator, 16, is_sanitized ? 64 : 900, brown + roughness(0.5), lights, materials, objects)));
    };
    const std::string point = "<pointlights><pointlight>" + vector_text("location", 1, 3, z) + "<scaleradiance>" +
                              text_of(intensity) +
                              "</scaleradiance><falloff>inversesquare</falloff></pointlight>"
                              "</pointlights>";
    const std::string first = "<path><maxdepth>1</maxdepth></path>";
    const double by_point = mean(first, point, "", "");
    INFO("z " << z);
    CHECK(by_point > 5e-4);
    const FloatPicture cast = rendered(scene("<raycast/>", 16, 4, brown, point)),
                       traced = rendered(scene(first, 16, 4, brown, point));
    double apart = 0;
    for (std::size_t i = 0; i < cast.pixels().size(); ++i)
      apart = std::max(apart, difference(cast.pixels()[i], traced.pixels()[i]));
    CHECK(apart < 1e-6);
    CHECK(mean(first, "", lamp(radiance), sphere(1, 3, z, radius, "lamp")) ==
          Approx(by_point).epsilon(is_sanitized ? 0.1 : 0.02));
  }
}

TEST_CASE("light that glass sends to hair is the same by paths, light paths and photons") {
  const std::string materials = lamp(60) + "<dielectrics><dielectric><name>glass</name></dielectric></dielectrics>";
  const std::string objects = sphere(0.3, 1.6, -1.2, 0.5, "glass") + sphere(0.6, 4, -3, 0.5, "lamp");
  const auto mean = [&](const std::string& caustics) {
    return mean_green(rendered(scene("<path><maxdepth>6</maxdepth><caustics>" + caustics + "</caustics></path>", 12,
                                     is_sanitized ? 64 : 4000, brown + roughness(0.6), "", materials, objects)));
  };
  const double by_paths = mean("none");
  INFO("by paths " << by_paths);
  CHECK(mean("light") == Approx(by_paths).epsilon(is_sanitized ? 0.2 : 0.03));
  CHECK(mean("photons") == Approx(by_paths).epsilon(is_sanitized ? 0.2 : 0.03));
}

TEST_CASE("pictures of hair have the same bits however they are made") {
  std::string text = scene("<path><maxdepth>5</maxdepth><caustics>photons</caustics></path>", 40, 8,
                           "<color red='0.8' green='0.5' blue='0.3' texture='along'/><roughness texture='along'>0.6"
                           "</roughness><opacity>0.8</opacity>",
                           "<pointlights><pointlight><location x='2' y='2' z='-3'/></pointlight></pointlights>"
                           "<environmentlights><environmentlight><scaleradiance>0.4</scaleradiance></environmentlight>"
                           "</environmentlights>",
                           lamp(5) + "<dielectrics><dielectric><name>glass</name></dielectric></dielectrics>",
                           sphere(0.5, 0.8, 1, 0.3, "glass") + sphere(-1, 1.4, -1, 0.3, "lamp"));
  text.insert(text.find("<materials>"),
              "<textures><checkers><checker><name>along</name><color1 red='1' green='1' blue='1'/><color2 red='0.3' "
              "green='0.6' blue='0.2'/><uvscale x='8' y='0'/></checker></checkers></textures>");
  check_same_bits(parsed_scene(text));
  const std::string paths = "<path><maxdepth>5</maxdepth><caustics>photons</caustics></path>";
  check_same_bits(parsed_scene(text.replace(text.find(paths), paths.size(), "<raycast/>")));
}

TEST_CASE("hair is clay in clay's scenes, and asks for paths by itself") {
  std::string text = scene("", 8, 4, brown, "");
  text.erase(text.find("<integrator>"), std::string("<integrator></integrator>").size());
  SceneDescription description = parsed_scene(text);
  REQUIRE_FALSE(make_clay(description));
  CHECK(std::get<MaterialItems<Hair>>(description.materials).empty());
  CHECK(std::get<MaterialItems<Matte>>(description.materials).size() == 1);
  REQUIRE(description.integrator);
  CHECK(std::holds_alternative<Path::Parameters>(*description.integrator));
}

}  // namespace raytrace::test
