// Rough transmission of OpenPBR: lights are drawn for it from both sides.
#include <cmath>
#include <string>

#include "render/fogged.h"
#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

const std::string of_openpbr = "<openpbrs><openpbr><name>frosted</name><transmission_weight>1</transmission_weight>",
                  of_dielectric = "<dielectrics><dielectric><name>frosted</name>";

/// Materials of that name: both kinds of rough glass, solid or thin.
std::string openpbr_glass(const std::string& more) { return of_openpbr + more + "</openpbr></openpbrs>"; }
std::string dielectric_glass(const std::string& more) { return of_dielectric + more + "</dielectric></dielectrics>"; }

const std::string black_sky = "<background red='0' green='0' blue='0'/>";

/// A ball of frosted glass before the camera, and other things.
std::string ball_scene(const std::string& materials, const std::string& objects, const std::string& viewplane,
                       const std::string& lights = "", int samples = 256, const std::string& path = "") {
  return "<raytracer><viewplane><hres>24</hres><vres>24</vres><samples>" + std::to_string(samples) + "</samples>" +
         viewplane +
         "</viewplane><camera><eye x='0' y='0' z='4'/><lookat x='0' y='0' z='0'/><fov>24</fov></camera><integrator>"
         "<path><maxdepth>16</maxdepth>" +
         path + "</path></integrator><lights>" + lights + "</lights><materials>" + materials +
         "<emissives><emissive><name>lamp</name><ce red='9' green='9' blue='9'/></emissive></emissives></materials>"
         "<objects><spheres><sphere><center x='0' y='0' "
         "z='0'/><radius>1</radius><material>frosted</material></sphere>" +
         objects + "</spheres></objects></raytracer>";
}

std::string small_lamp(const std::string& center, double radius) {
  return "<sphere>" + center + "<radius>" + std::to_string(radius) + "</radius><material>lamp</material></sphere>";
}
/// As bright as that, from there.
std::string point_light(const std::string& location, double radius) {
  return "<pointlights><pointlight>" + location + "<scaleradiance>" + std::to_string(9 * radius * radius * 3.14159265) +
         "</scaleradiance><falloff>inversesquare</falloff></pointlight></pointlights>";
}

double noise_of(const std::string& text) {
  const SceneDescription description = parsed_scene(text);
  const FloatPicture one = rendered(description, 1, {}, 1), other = rendered(description, 1, {}, 2);
  double square = 0;
  for (std::size_t i = 0; i < one.pixels().size(); ++i)
    square += std::pow(double{one.pixels()[i].green} - double{other.pixels()[i].green}, 2);
  return std::sqrt(square / 2 / static_cast<double>(one.pixels().size())) / mean_green(one);
}

const std::string rough = "<specular_roughness>0.4</specular_roughness>",
                  thin = "<geometry_thin_walled>true</geometry_thin_walled>",
                  deep =
                      "<transmission_color red='0.5' green='0.5' blue='0.5'/><transmission_depth>1"
                      "</transmission_depth>",
                  layers =
                      "<coat_weight>0.5</coat_weight><thin_film_weight>1</thin_film_weight>"
                      "<specular_roughness_anisotropy>0.5</specular_roughness_anisotropy>";

}  // namespace

TEST_CASE("rough OpenPBR: a sky for which light is drawn is as bright behind it as one that paths meet") {
  const std::string sky =
      "<environmentlights><environmentlight><color red='1' green='1' blue='1'/></environmentlight></environmentlights>";
  const std::string background = "<background red='1' green='1' blue='1'/>";
  for (const std::string& more : {deep, thin, thin + layers}) {
    const std::string glass = openpbr_glass(rough + more);
    const double drawn = mean_green(rendered(ball_scene(glass, "", black_sky, sky)));
    const double met = mean_green(rendered(ball_scene(glass, "", background)));
    INFO(more << ": " << drawn << ", " << met);
    CHECK(std::abs(drawn / met - 1) < 0.006);
  }
}

TEST_CASE("rough OpenPBR: a small lamp in it or behind it lights it without much noise") {
  for (const std::string center : {"<center x='0' y='0.2' z='0'/>", "<center x='0' y='0' z='-1.6'/>"})
    for (const std::string& more : {std::string(), thin}) {
      const std::string glass = openpbr_glass("<specular_roughness>0.6</specular_roughness>" + more);
      const double noise = noise_of(ball_scene(glass, small_lamp(center, 0.05), black_sky));
      INFO("noise " << noise << " of the mean");
      CHECK(noise < 0.25);
    }
}

TEST_CASE("rough glass: points shine through it as small lamps do, and suns") {
  const double radius = 0.05;
  const std::string sun =
      "<directionallights><directionallight><direction x='0' y='0.3' z='-1'/><scaleradiance>3"
      "</scaleradiance></directionallight></directionallights>";
  for (const std::string& glass : {openpbr_glass(rough), openpbr_glass(rough + thin),
                                   openpbr_glass(rough + thin + layers), dielectric_glass("<roughness>0.4</roughness>"),
                                   dielectric_glass("<roughness>0.4</roughness><thinwalled>true</thinwalled>")}) {
    for (const std::string place : {"x='0' y='0.2' z='0'", "x='0' y='0.5' z='-2'"}) {
      const FloatPicture lamp =
          rendered(ball_scene(glass, small_lamp("<center " + place + "/>", radius), black_sky, "", 128));
      const FloatPicture point =
          rendered(ball_scene(glass, "", black_sky, point_light("<location " + place + "/>", radius), 128));
      INFO(glass << " at " << place << ": " << mean_green(point) << ", lamp " << mean_green(lamp));
      CHECK(std::abs(mean_green(point) / mean_green(lamp) - 1) < 0.05);
    }
    CHECK(mean_green(rendered(ball_scene(glass, "", black_sky, sun, 16))) > 0.02);
  }
}

TEST_CASE("rough OpenPBR: it is as bright as rough glass of the same roughness before a lamp") {
  const std::string lamp = small_lamp("<center x='0' y='0.8' z='-2'/>", 0.6);
  const double solid = mean_green(rendered(ball_scene(openpbr_glass(rough), lamp, black_sky)));
  const double wanted =
      mean_green(rendered(ball_scene(dielectric_glass("<roughness>0.4</roughness>"), lamp, black_sky)));
  INFO(solid << ", " << wanted);
  CHECK(std::abs(solid / wanted - 1) < 0.02);
}

TEST_CASE("rough OpenPBR: light paths and photons bring nothing again that is drawn from behind") {
  // A smooth ball beside it is what light paths go by.
  const std::string glass = "<openpbrs><openpbr><name>frosted</name><transmission_weight>1</transmission_weight>" +
                            rough +
                            "</openpbr><openpbr><name>clear</name><transmission_weight>1</transmission_weight>"
                            "<specular_roughness>0</specular_roughness></openpbr></openpbrs>";
  const std::string things =
      small_lamp("<center x='0.5' y='1.2' z='-2.5'/>", 0.7) +
      "<sphere><center x='-0.3' y='-0.9' z='-1.4'/><radius>0.6</radius><material>clear</material>"
      "</sphere><sphere><center x='-1.3' y='0.3' z='0.9'/><radius>0.4</radius><material>clear"
      "</material></sphere>";
  const auto mean = [&](const std::string& caustics) {
    return mean_green(
        rendered(ball_scene(glass, things, black_sky, "", 1024, "<caustics>" + caustics + "</caustics>")));
  };
  const double none = mean("none");
  for (const std::string kind : {"light", "photons"}) {
    const double with = mean(kind);
    INFO(kind << ": " << with << ", without: " << none);
    CHECK(std::abs(with / none - 1) < 0.02);
  }
}

TEST_CASE("rough glass: what shines through it comes into the fog that begins there") {
  const std::string lights = GENERATE(
      "<directionallights><directionallight><direction x='0.1' y='0' z='-1'/></directionallight>"
      "</directionallights>",
      "<pointlights><pointlight><location x='0.4' y='0' z='-6'/></pointlight></pointlights>", "");
  const auto mean = [&](bool has_fog) {
    Fogged scene;
    scene.fog = "<color red='0' green='0' blue='0'/>";
    if (!has_fog) scene.box = "";
    scene.materials = openpbr_glass(rough + thin);
    scene.lights = lights;
    scene.objects =
        "<rectangles><rectangle><corner x='-60' y='-60' z='-3'/><edge1 x='120' y='0' z='0'/><edge2 x='0' y='120' "
        "z='0'/>"
        "<material>frosted</material></rectangle></rectangles>";
    if (lights.empty()) scene.objects += "<spheres>" + small_lamp("<center x='0.6' y='0' z='-6'/>", 0.5) + "</spheres>";
    scene.path = "<maxdepth>4</maxdepth>";
    scene.background = black_sky;
    return mean_of(scene).green;
  };
  const double wanted = mean(false) * std::exp(-5 / mean_free_path), got = mean(true);
  INFO(lights << ": " << got << ", wanted " << wanted);
  CHECK(wanted > 0.001);
  CHECK(std::abs(got / wanted - 1) < 0.01);
}

TEST_CASE("rough glass: it is as bright however close behind it a fog ends") {
  // Behind a block of glass, and not as far as the lights.
  const std::string lights = GENERATE(
      "<directionallights><directionallight><direction x='0.1' y='0' z='-1'/></directionallight></directionallights>",
      "");
  const auto mean = [&](const std::string& end) {
    const std::string lamp =
        "<rectangles><rectangle><corner x='-1' y='-1' z='-9'/><edge1 x='2' y='0' z='0'/><edge2 x='0' y='2' z='0'/>"
        "<material>lamp</material></rectangle></rectangles>";
    return mean_green(rendered(parsed_scene(
        "<raytracer><viewplane><hres>12</hres><vres>12</vres><samples>64</samples>" + black_sky +
        "</viewplane><camera><eye x='0' y='0' z='3'/><lookat x='0' y='0' z='0'/><fov>20</fov></camera><integrator>"
        "<path><maxdepth>4</maxdepth></path></integrator><lights>" +
        lights + "</lights><materials>" + openpbr_glass(rough) +
        "<emissives><emissive><name>lamp</name><ce red='9' green='9' blue='9'/></emissive></emissives><fogs><fog>"
        "<name>mist</name><meanfreepath>2</meanfreepath><color red='0' green='0' blue='0'/></fog></fogs></materials>"
        "<objects><boxes><box><min x='-2' y='-2' z='-0.1'/><max x='2' y='2' z='0'/><material>frosted</material></box>"
        "<box><min x='-2.5' y='-2.5' z='-1.6'/><max x='2.5' y='2.5' z='" +
        end + "'/><material>mist</material></box></boxes>" + (lights.empty() ? lamp : "") + "</objects></raytracer>")));
  };
  const double exact = mean("-0.1");
  CHECK(exact > 0.001);
  for (const std::string end : {"-0.0999999", "-0.1000001", "-0.100001"}) {
    INFO(end << ", " << (lights.empty() ? "lamp" : "sun") << ": " << mean(end) << ", wanted " << exact);
    CHECK(std::abs(mean(end) / exact - 1) < 1e-3);
  }
}

TEST_CASE("rough OpenPBR: what shines through it shines through panes behind it as well") {
  const std::string glass = openpbr_glass(rough + thin) +
                            "<dielectrics><dielectric><name>air</name><ior>1</ior><thinwalled>true</thinwalled>"
                            "</dielectric></dielectrics>";
  const std::string place = "x='0' y='0.5' z='-2.5'";
  const std::string pane = "<sphere><center x='0' y='0' z='0'/><radius>1.5</radius><material>air</material></sphere>";
  const std::string lamp = small_lamp("<center " + place + "/>", 0.1);
  const std::string point = point_light("<location " + place + "/>", 0.1);
  const double open = mean_green(rendered(ball_scene(glass, "", black_sky, point)));
  const double behind = mean_green(rendered(ball_scene(glass, pane, black_sky, point)));
  INFO("a point: " << behind << " for " << open);
  CHECK(std::abs(behind / open - 1) < 0.02);
  const double lit = mean_green(rendered(ball_scene(glass, pane + lamp, black_sky)));
  INFO("a lamp: " << lit);
  CHECK(std::abs(lit / open - 1) < 0.05);
  CHECK(noise_of(ball_scene(glass, pane + lamp, black_sky)) < 0.5);
}

}  // namespace raytrace::test
