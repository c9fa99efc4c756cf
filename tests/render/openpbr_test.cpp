// OpenPBR's materials in pictures: nothing is lost, lamps of them shine, and their bits are the same however they come.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <algorithm>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"

namespace raytrace::test {

namespace {

std::string openpbr(const std::string& name, const std::string& more) {
  return "<openpbr><name>" + name + "</name>" + more + "</openpbr>";
}
std::string pbr_ball(double x, double y, double radius, const std::string& material) {
  return "<sphere>" + vector_text("center", x, y, 0) + "<radius>" + std::to_string(radius) + "</radius><material>" +
         material + "</material></sphere>";
}

/// The mean of green of a ball that fills the picture, under a white sky.
double mean_of_pbr_ball(const std::string& more, const std::string& background = "1") {
  return mean_green(rendered(
      "<raytracer><integrator><path><maxdepth>200</maxdepth></path></integrator><viewplane><hres>16</hres><vres>16"
      "</vres><samples>" +
      std::to_string(is_sanitized ? 64 : 256) + "</samples><background red='1' green='" + background +
      "' blue='1'/></viewplane><camera><eye x='0' y='0.2' z='3'/><lookat x='0' y='0' z='0'/><fov>24</fov></camera>"
      "<materials><openpbrs>" +
      openpbr("m", more) + "</openpbrs></materials><objects><spheres>" + pbr_ball(0, 0, 1, "m") +
      "</spheres></objects></raytracer>"));
}

const std::string white_base = "<base_color red='1' green='1' blue='1'/>";

}  // namespace

TEST_CASE("an OpenPBR ball that absorbs nothing cannot be seen under a white sky") {
  for (const std::string layers :
       {"", "<base_diffuse_roughness>1</base_diffuse_roughness>", "<base_metalness>1</base_metalness>",
        "<transmission_weight>1</transmission_weight>", "<transmission_weight>0.5</transmission_weight>",
        "<transmission_weight>1</transmission_weight><geometry_thin_walled>true</geometry_thin_walled>",
        "<coat_weight>1</coat_weight>", "<fuzz_weight>1</fuzz_weight>",
        "<coat_weight>0.5</coat_weight><coat_roughness>0.4</coat_roughness><fuzz_weight>0.5</fuzz_weight>"
        "<base_metalness>0.5</base_metalness><transmission_weight>0.5</transmission_weight>"}) {
    INFO(layers);
    CHECK(mean_of_pbr_ball(white_base + layers) == Approx(1).epsilon(0.005));
  }
}

TEST_CASE("what an OpenPBR material emits, and a clear coat lets through") {
  const std::string lamp =
      "<base_weight>0</base_weight><specular_weight>0</specular_weight><emission_luminance>3"
      "</emission_luminance><emission_color red='1' green='0.5' blue='1'/>";
  CHECK(mean_of_pbr_ball(lamp, "0") == Approx(1.5).epsilon(1e-3));
  CHECK(mean_of_pbr_ball(lamp + "<coat_weight>1</coat_weight><coat_ior>1</coat_ior><coat_color red='1' green='0.25' "
                                "blue='1'/>",
                         "0") == Approx(0.75).epsilon(1e-3));
}

TEST_CASE("light is drawn from lamps of OpenPBR as from those of <emissive>") {
  const auto lit_by = [](const std::string& lamp) {
    return rendered(parsed_scene(scene_text(
        16, 12, 64,
        "<materials><mattes><matte><name>floor</name><ka>0</ka><kd>0.7</kd><cd red='1' green='1' blue='1'/></matte>"
        "</mattes>" +
            lamp + "</materials><objects><spheres>" + pbr_ball(0, 3, 0.5, "lamp") +
            "</spheres><planes><plane><point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/><material>floor</material>"
            "</plane></planes></objects>")));
  };
  const FloatPicture a = lit_by("<openpbrs>" +
                                openpbr("lamp",
                                        "<base_weight>0</base_weight><specular_weight>0</specular_weight>"
                                        "<emission_luminance>9</emission_luminance>") +
                                "</openpbrs>"),
                     b = lit_by(
                         "<emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/><scaleradiance>9"
                         "</scaleradiance></emissive></emissives>");
  double worst = 0;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) worst = std::max(worst, difference(a.at(x, y), b.at(x, y)));
  CHECK(worst < 1e-4);
}

TEST_CASE("paths by OpenPBR's materials do not depend on threads, samples at once, or cuts") {
  check_same_bits_of_balls(
      "<conductors><conductor><name>gold</name><metal>gold</metal><roughness>0.3</roughness><anisotropy>0.7</"
      "anisotropy>"
      "</conductor></conductors><openpbrs>" +
          openpbr("plastic", "<base_color texture='checks'/><specular_roughness texture='checks'/>") +
          openpbr("brushed",
                  "<base_metalness>1</base_metalness><specular_roughness_anisotropy>0.8"
                  "</specular_roughness_anisotropy>") +
          openpbr("glass",
                  "<transmission_weight texture='checks'/><transmission_color red='0.5' green='0.9' blue='0.7'/>"
                  "<transmission_depth>1</transmission_depth>") +
          openpbr("coated", "<coat_weight texture='checks'/><coat_color red='0.9' green='0.5' blue='0.2'/>") +
          openpbr("fuzzy", "<fuzz_weight>1</fuzz_weight><emission_luminance>0.2</emission_luminance>") + "</openpbrs>",
      {"plastic", "brushed", "glass", "coated", "fuzzy", "gold"});
}

}  // namespace raytrace::test
