// Shadow rays through thin, clear walls: as much light as Fresnel's equations let through, of all lights, with as
// little noise as without the walls.
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

const std::string panes_materials =
    "<textures><checkers><checker><name>squares</name><color1 red='0.5' green='0.5' blue='0.5'/><color2 red='0.5' "
    "green='0.5' blue='0.5'/>"
    "</checker></checkers></textures><materials><mattes><matte><name>floor</name><ka>0</ka><kd>1</kd>"
    "<cd red='1' green='1' blue='1'/></matte></mattes><dielectrics><dielectric><name>window</name>"
    "<thinwalled>true</thinwalled></dielectric><dielectric><name>green</name><ct red='0.5' green='1' blue='0.5'/>"
    "<thinwalled>true</thinwalled></dielectric><dielectric><name>air</name><ior>1</ior><thinwalled>true</thinwalled>"
    "</dielectric><dielectric><name>thick</name></dielectric><dielectric><name>frosted</name><roughness>0.3</roughness>"
    "<thinwalled>true</thinwalled></dielectric><dielectric><name>half there</name><ior>1</ior><opacity>0.5</opacity>"
    "<ct red='0' green='0' blue='0'/><thinwalled>true</thinwalled></dielectric><dielectric><name>printed</name>"
    "<ior>1</ior><ct texture='squares'/><thinwalled>true</thinwalled></dielectric><dielectric><name>polished</name>"
    "<roughness texture='squares'>0</roughness><thinwalled>true</thinwalled></dielectric></dielectrics><openpbrs>"
    "<openpbr><name>polished sheet</name><transmission_weight>1</transmission_weight><specular_roughness "
    "texture='squares'>0</specular_roughness><geometry_thin_walled>true</geometry_thin_walled></openpbr><openpbr>"
    "<name>sheet</name><transmission_weight>1</transmission_weight><transmission_color red='0.5' green='1' blue='0.5'/>"
    "<specular_roughness>0</specular_roughness><geometry_thin_walled>true</geometry_thin_walled></openpbr>"
    "<openpbr><name>misted</name><transmission_weight>1</transmission_weight><specular_roughness>0</specular_roughness>"
    "<geometry_thin_walled>true</geometry_thin_walled><coat_weight>0.7</coat_weight><coat_roughness>0.1"
    "</coat_roughness></openpbr></openpbrs><emissives><emissive><name>lamp</name><ce red='4' green='4' "
    "blue='4'/></emissive></emissives></materials>";

std::string pane_at(double height, const std::string& material) {
  return "<rectangle><corner x='-9' y='" + std::to_string(height) +
         "' z='-9'/><edge1 x='18' y='0' z='0'/><edge2 x='0' y='0' z='18'/><material>" + material +
         "</material></rectangle>";
}

const std::string lamp_rectangle =
    "<rectangle><corner x='-1' y='4' z='-1'/><edge1 x='2' y='0' z='0'/><edge2 x='0' y='0' z='2'/><material>lamp"
    "</material></rectangle>";

/// The camera is below the panes, and looks down at a white floor.
std::string floor_below(const std::string& lights, const std::string& rectangles,
                        const std::string& integrator = "<path/>", int samples = 16,
                        const std::string& eye = "<eye x='0' y='0.5' z='0.01'/>") {
  std::string text =
      scene_text(8, 8, samples,
                 "<integrator>" + integrator + "</integrator><lights>" + lights + "</lights>" + panes_materials +
                     "<objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>floor"
                     "</material></plane></planes><rectangles>" +
                     rectangles + "</rectangles></objects>",
                 eye + "<lookat x='0' y='0' z='0'/>");
  const std::string background = "<background red='0.1' green='0.2' blue='0.4'/>";
  return text.erase(text.find(background), background.size());
}

struct Light {
  double mean, deviation;
};
Light green_of(const std::string& text) {
  const FloatPicture picture = rendered(parsed_scene(text));
  double sum = 0, squares = 0;
  const auto count = static_cast<double>(picture.pixels().size());
  for (const Pixel& pixel : picture.pixels()) {
    sum += double{pixel.green};
    squares += double{pixel.green} * double{pixel.green};
  }
  return {sum / count, std::sqrt(std::max(squares / count - sum / count * (sum / count), 0.0))};
}

const std::string overhead_sun =
    "<directionallights><directionallight><direction x='0' y='1' z='0'/><scaleradiance>3</scaleradiance>"
    "</directionallight></directionallights>";

/// Light on the floor goes no second way: it would come back from the panes.
const std::string one_bounce = "<path><maxdepth>3</maxdepth></path>";

constexpr double through_window = 1 - 2 * 0.04 / 1.04;  // of a pane of glass, straight: reflected by both faces

}  // namespace

TEST_CASE("suns and points shine through panes by as much as comes through") {
  const std::string lights = GENERATE(
      as<std::string>(), overhead_sun,
      "<pointlights><pointlight><location x='0' y='30' z='0'/><scaleradiance>900</scaleradiance><falloff>inversesquare"
      "</falloff></pointlight></pointlights>",
      "<directionallights><directionallight><direction x='0' y='1' z='0'/><scaleradiance>3</scaleradiance><angle>0.5"
      "</angle></directionallight></directionallights>");
  const double open = green_of(floor_below(lights, "", "<path><maxdepth>1</maxdepth></path>")).mean;
  // The camera's ray, the floor and the panes: what comes from the floor to a pane and back is the fourth.
  const auto below = [&](const std::string& panes, int depth) {
    return green_of(floor_below(lights, panes, "<path><maxdepth>" + std::to_string(depth) + "</maxdepth></path>")).mean;
  };
  CHECK(below(pane_at(2, "window"), 2) == Approx(open * through_window).epsilon(2e-3));
  CHECK(below(pane_at(2, "green"), 2) == Approx(open * through_window).epsilon(2e-3));
  CHECK(below(pane_at(2, "sheet"), 2) == Approx(open * through_window).epsilon(2e-3));
  CHECK(below(pane_at(2, "polished"), 2) == Approx(open * through_window).epsilon(2e-3));
  CHECK(below(pane_at(2, "polished sheet"), 2) == Approx(open * through_window).epsilon(2e-3));
  CHECK(below(pane_at(2, "air") + pane_at(2.5, "air") + pane_at(3, "air"), 4) == Approx(open).epsilon(2e-3));
  CHECK(below(pane_at(2, "half there"), 2) == Approx(open * 0.5).epsilon(0.15));
  CHECK(below(pane_at(2, "printed"), 2) == Approx(open * 0.5).epsilon(1e-3));
  // Each pane is a scattering, and other glass casts shadows.
  CHECK(below(pane_at(2, "air") + pane_at(2.5, "air"), 2) == 0);
  CHECK(below(pane_at(2, "thick"), 2) == 0);
  // Shadow rays to the floor do not come through a frosted one, but paths that meet it find its light.
  CHECK(below(pane_at(2, "frosted"), 1) == 0);
  CHECK(below(pane_at(2, "frosted"), 2) > 0.05 * open);
}

TEST_CASE("a sheet that its coat makes rough is no pane") {
  CHECK(green_of(floor_below(overhead_sun, pane_at(2, "misted"))).mean < green_of(floor_below(overhead_sun, "")).mean);
  const std::string lamp_above = "<path><maxdepth>3</maxdepth></path>";
  const double open = green_of(floor_below("", lamp_rectangle, lamp_above, 256)).mean;
  const double misted = green_of(floor_below("", lamp_rectangle + pane_at(2, "misted"), lamp_above, 256)).mean;
  CHECK(misted > 0.5 * open);
  CHECK(misted < open);
}

TEST_CASE("the colour of a pane is that of the light behind it") {
  const FloatPicture picture =
      rendered(parsed_scene(floor_below(overhead_sun, pane_at(2, "green"), "<path><maxdepth>2</maxdepth></path>")));
  CHECK(picture.at(4, 4).red == Approx(picture.at(4, 4).green / 2));
}

TEST_CASE("lamps and skies behind a pane that reflects nothing light as if it were not there, without more noise") {
  const std::string sky =
      "<environmentlights><environmentlight><color red='1' green='1' blue='1'/></environmentlight></environmentlights>";
  const bool has_sky = GENERATE(true, false), is_deep = GENERATE(true, false);
  const std::string lights = has_sky ? sky : "", rectangles = has_sky ? "" : lamp_rectangle;
  const std::string integrator = is_deep ? "<path/>" : one_bounce;
  const Light open = green_of(
                  floor_below(lights, rectangles, is_deep ? "<path/>" : "<path><maxdepth>2</maxdepth></path>", 256)),
              behind = green_of(floor_below(lights, rectangles + pane_at(2, "air"), integrator, 256));
  INFO((has_sky ? "sky" : "lamp") << (is_deep ? ", deep" : ", shallow"));
  CHECK(behind.mean == Approx(open.mean).epsilon(0.01));
  CHECK(behind.deviation < 1.5 * open.deviation + 1e-3);
}

TEST_CASE("where light paths go through panes, shadow rays do not bring their light as well") {
  const auto mean = [](const std::string& caustics, const std::string& lights, const std::string& rectangles) {
    return green_of(floor_below(lights, rectangles,
                                "<path><maxdepth>3</maxdepth><caustics>" + caustics + "</caustics></path>", 4096,
                                "<eye x='0' y='1.9' z='0.01'/>"))
        .mean;
  };
  const std::string point =
      "<pointlights><pointlight><location x='0' y='4' z='0'/><scaleradiance>9</scaleradiance><falloff>inversesquare"
      "</falloff></pointlight></pointlights>";
  for (const std::string& light : {point, std::string()}) {
    const std::string rectangles = (light.empty() ? lamp_rectangle : "") + pane_at(2, "window");
    const double by_shadow_rays = mean("none", light, rectangles);
    CHECK(mean("light", light, rectangles) == Approx(by_shadow_rays).epsilon(0.04));
    CHECK(mean("photons", light, rectangles) == Approx(by_shadow_rays).epsilon(0.04));
  }
  CHECK(green_of(floor_below(overhead_sun, pane_at(2, "window"), "<raycast/>")).mean == 0);
  // They do not go to what has no end.
  const auto endless = [](const std::string& caustics) {
    std::string text =
        floor_below(overhead_sun, "", "<path><maxdepth>2</maxdepth><caustics>" + caustics + "</caustics></path>");
    text.replace(
        text.find("</planes>"), 9,
        "<plane><point x='0' y='2' z='0'/><normal x='0' y='1' z='0'/><material>window</material></plane></planes>");
    return green_of(text).mean;
  };
  CHECK(endless("light") > 0.5);
  CHECK(endless("light") == Approx(endless("none")));
}

TEST_CASE("on a shadow catcher, a pane's shadow is what it does not let through") {
  std::string text = floor_below(overhead_sun, pane_at(2, "green"), "<path/>", 1024);
  const std::string floor_end = "<material>floor</material></plane>";
  text.insert(text.find(floor_end) + floor_end.size() - std::string("</plane>").size(),
              "<shadowcatcher>true</shadowcatcher>");
  const SceneDescription scene = parsed_scene(text);
  const auto built = build_scene(scene, {1, {}});
  RayCounts rays;
  RenderSettings settings{1, 0, whole(scene)};
  settings.transparent = true;
  const FloatPicture picture = render(*built, scene, settings, rays);
  double alpha = 0;
  for (const Pixel& pixel : picture.pixels())
    alpha += double{pixel.alpha} / static_cast<double>(picture.pixels().size());
  CHECK(alpha == Approx(1 - through_window * (0.5 + 1 + 0.5) / 3).epsilon(0.02));
}

TEST_CASE("pictures of what is behind panes depend on no cut") {
  const std::string rectangles =
      lamp_rectangle + pane_at(2, "green") + pane_at(2.5, "half there") + pane_at(3, "printed") + pane_at(1.5, "sheet");
  SceneDescription scene = parsed_scene(floor_below(overhead_sun, rectangles, "<path/>", 4));
  check_same_bits(scene);
}

}  // namespace raytrace::test
