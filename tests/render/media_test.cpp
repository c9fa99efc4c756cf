// Clear media in each other: against closed forms of slabs, and light paths against paths from the camera.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <string>
#include <utility>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

std::string dielectric(const std::string& name, double ior, const std::string& more = "") {
  return "<dielectric><name>" + name + "</name><ior>" + std::to_string(ior) + "</ior>" + more + "</dielectric>";
}

/// A box as wide as the world, from one z to another.
std::string slab(double from, double to, const std::string& material) {
  return "<box><min x='-9' y='-9' z='" + std::to_string(from) + "'/><max x='9' y='9' z='" + std::to_string(to) +
         "'/><material>" + material + "</material></box>";
}

/// What a camera at z = 0.5 sees that looks along z, of a wall of radiance 1 at z = 0.25 behind it, of which nothing
/// comes from elsewhere.
double reflected(const std::string& dielectrics, const std::string& boxes, const std::string& isa = {}) {
  const FloatPicture picture = rendered(
      parsed_scene("<raytracer><viewplane><hres>8</hres><vres>8</vres><samples>256</samples></viewplane><camera>"
                   "<eye x='0' y='0' z='0.5'/><lookat x='0' y='0' z='2'/><fov>0.1</fov></camera><integrator><path>"
                   "<maxdepth>32</maxdepth></path></integrator><materials><dielectrics>" +
                   dielectrics +
                   "</dielectrics><emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/></emissive>"
                   "</emissives></materials><objects><rectangles><rectangle><corner x='-9' y='-9' z='0.25'/>"
                   "<edge1 x='18' y='0' z='0'/><edge2 x='0' y='18' z='0'/><material>lamp</material></rectangle>"
                   "</rectangles><boxes>" +
                   boxes + "</boxes></objects></raytracer>"),
      2, isa);
  return mean_green(picture);
}

double fresnel(double ratio) { return (ratio - 1) * (ratio - 1) / ((ratio + 1) * (ratio + 1)); }

/// Two surfaces one behind the other, which reflect these shares each.
double both(double first, double second) { return first + (1 - first) * (1 - first) * second / (1 - first * second); }

}  // namespace

TEST_CASE("a slab in a medium around it and the camera reflects by the ratio of their indices") {
  for (const std::string& isa : usable_isas()) {
    const double in_air = reflected(dielectric("glass", 3), slab(1, 2, "glass"), isa);
    CHECK(std::abs(in_air - both(fresnel(3), fresnel(3))) < 0.01);
    const double in_water =
        reflected(dielectric("glass", 3) + dielectric("water", 1.5), slab(-8, 8, "water") + slab(1, 2, "glass"), isa);
    // What comes through the slab is reflected at the water's end as well.
    const double slab_in_water = both(fresnel(2), fresnel(2)), end = fresnel(1.5);
    INFO(isa << ": " << in_water);
    CHECK(std::abs(in_water - both(slab_in_water, end)) < 0.01);
  }
}

TEST_CASE("what ends inside of a medium of higher priority is not there") {
  const std::string water = dielectric("water", 1.5);
  // The water reaches into the glass, which has air behind it.
  const std::string boxes = slab(-8, 1.4, "water") + slab(1, 2, "glass");
  const double first = reflected(water + dielectric("glass", 3, "<priority>1</priority>"), boxes);
  INFO(first);
  CHECK(std::abs(first - both(fresnel(2), fresnel(3))) < 0.01);
  // And if the water counts more, the glass begins where the water ends.
  const double last = reflected(
      dielectric("water", 1.5, "<priority>2</priority>") + dielectric("glass", 3, "<priority>1</priority>"), boxes);
  INFO(last);
  CHECK(std::abs(last - both(fresnel(2), fresnel(3))) < 0.01);
  // Beginning and end of what lies in one that counts more.
  const double hidden = reflected(dielectric("water", 1.5, "<priority>2</priority>") + dielectric("glass", 3),
                                  slab(-8, 8, "water") + slab(1, 2, "glass"));
  CHECK(std::abs(hidden - fresnel(1.5)) < 0.01);
}

TEST_CASE("two that are one in the other of the same index are one") {
  const double one = reflected(dielectric("outer", 2), slab(1, 5, "outer"));
  const double two =
      reflected(dielectric("outer", 2) + dielectric("inner", 2), slab(1, 5, "outer") + slab(2, 3, "inner"));
  CHECK(std::abs(one - both(fresnel(2), fresnel(2))) < 0.01);
  CHECK(std::abs(two - one) < 0.01);
}

TEST_CASE("a medium attenuates light on its way to whatever is in it") {
  const std::string water = dielectric("water", 1,
                                       "<attenuationcolor red='0.5' green='0.5' blue='0.5'/>"
                                       "<attenuationdistance>1</attenuationdistance>");
  // From the camera to a mirror of two metres' distance and back to the lamp, 0.25 behind it.
  const std::string mirror =
      "<raytracer><viewplane><hres>4</hres><vres>4</vres><samples>4</samples></viewplane><camera>"
      "<eye x='0' y='0' z='0.5'/><lookat x='0' y='0' z='2'/><fov>0.1</fov></camera><integrator><path/></integrator>"
      "<lights>LIGHT</lights><materials><dielectrics>" +
      water +
      "</dielectrics><mirrors><mirror><name>mirror</name><cr red='1' green='1' blue='1'/></mirror></mirrors>"
      "<mattes><matte><name>grey</name><ka>0</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/></matte></mattes>"
      "<emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/></emissive></emissives></materials>"
      "<objects><rectangles><rectangle><corner x='-9' y='-9' z='0.25'/><edge1 x='18' y='0' z='0'/>"
      "<edge2 x='0' y='18' z='0'/><material>BEHIND</material></rectangle></rectangles><boxes>" +
      slab(-8, 8, "water") + slab(2.5, 3, "FRONT") + "</boxes></objects></raytracer>";
  const auto with = [&](const std::string& light, const std::string& behind, const std::string& front) {
    std::string scene = mirror;
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{"LIGHT", light}, {"BEHIND", behind}, {"FRONT", front}})
      scene.replace(scene.find(from), from.size(), to);
    return scene;
  };
  CHECK(std::abs(double{rendered(with("", "lamp", "mirror")).at(2, 2).green} - std::pow(0.5, 2 + 2.25)) < 1e-3);
  // A point light beside the camera lights a wall: 2 to it, 2 back.
  const std::string light =
      "<pointlights><pointlight><location x='0' y='0' z='0.5'/><color red='1' green='1' blue='1'/>"
      "<shadows>false</shadows></pointlight></pointlights>";
  const auto lit = [&](const std::string& distance) {
    std::string scene = with(light, "grey", "grey");
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{"<path/>", "<path><maxdepth>1</maxdepth></path>"},
          {"<attenuationdistance>1<", "<attenuationdistance>" + distance + "<"}})
      scene.replace(scene.find(from), from.size(), to);
    return double{rendered(scene).at(2, 2).green};
  };
  const double in_water = lit("1"), in_air = lit("1e9");
  CHECK(in_air > 0.01);
  CHECK(std::abs(in_water / in_air - std::pow(0.5, 4)) < 1e-3);
}

namespace {

/// A glass ball half in a basin of water whose walls it touches not, over a lit floor; the water reaches into the
/// basin's glass. A lamp hangs above, or stands in the water.
SceneDescription basin(const std::string& caustics, int samples, bool lamp_in_water) {
  return parsed_scene(
      "<raytracer><viewplane><hres>16</hres><vres>16</vres><samples>" + std::to_string(samples) +
      "</samples></viewplane><camera><eye x='0' y='3.5' z='5'/><lookat x='0' y='0' z='0'/><fov>40</fov></camera>"
      "<integrator><path><maxdepth>12</maxdepth><caustics>" +
      caustics + "</caustics></path></integrator><materials><dielectrics>" +
      dielectric("glass", 1.5, "<priority>1</priority>") +
      dielectric("water", 1.33,
                 "<attenuationcolor red='0.6' green='0.8' blue='0.9'/><attenuationdistance>1</attenuationdistance>") +
      "</dielectrics><mattes><matte><name>grey</name><ka>0</ka><kd>1</kd><cd red='0.6' green='0.6' blue='0.6'/></matte>"
      "</mattes><emissives><emissive><name>lamp</name><ce red='9' green='9' blue='9'/></emissive></emissives>"
      "</materials><objects><planes><plane><point x='0' y='-0.2' z='0'/><normal x='0' y='1' z='0'/>"
      "<material>grey</material></plane></planes><boxes>"
      "<box><min x='-1.5' y='-0.1' z='-1.5'/><max x='1.5' y='0.2' z='1.5'/><material>glass</material></box>"
      "<box><min x='-1.4' y='0.1' z='-1.4'/><max x='1.4' y='0.9' z='1.4'/><material>water</material></box></boxes>"
      "<spheres><sphere><center x='-0.5' y='0.9' z='0'/><radius>0.4</radius><material>glass</material></sphere>"
      "<sphere><center x='0.7' y='" +
      std::string(lamp_in_water ? "0.55" : "2.2") +
      "' z='0.3'/><radius>0.25</radius><material>lamp</material></sphere></spheres></objects></raytracer>");
}

double mean_of(const FloatPicture& picture) {
  double sum = 0;
  for (const Pixel& pixel : picture.pixels()) sum += double{pixel.red} + double{pixel.green} + double{pixel.blue};
  return sum / (3 * static_cast<double>(picture.pixels().size()));
}

}  // namespace

TEST_CASE("light paths through media in each other bring what paths from the camera would") {
  for (const bool lamp_in_water : {false, true}) {
    const double by_chance = mean_of(rendered(basin("none", is_sanitized ? 256 : 2048, lamp_in_water), 2));
    for (const std::string caustics : {"light", "photons"}) {
      const double by_light = mean_of(rendered(basin(caustics, is_sanitized ? 64 : 512, lamp_in_water), 2));
      INFO(caustics << ", lamp in water: " << lamp_in_water << ", " << by_light << " for " << by_chance);
      CHECK(std::abs(by_light / by_chance - 1) < (is_sanitized ? 0.06 : 0.015));
    }
  }
}

TEST_CASE("light that a medium swallows on its way out of a hidden boundary is gone, beside instances, too") {
  // A ball of milk that begins in one of glass: paths walk to the glass' hidden surface, and some do not arrive.
  const auto ball = [](double x, const std::string& material) {
    return "<spheres><sphere><center x='" + std::to_string(x) + "' y='0' z='0'/><radius>1</radius><material>" +
           material + "</material></sphere></spheres>";
  };
  const std::string scene =
      scene_text(32, 32, 64,
                 "<integrator><path/></integrator><materials><dielectrics><dielectric><name>glass</name></dielectric>"
                 "</dielectrics><openpbrs><openpbr><name>milk</name><transmission_weight>1</transmission_weight>"
                 "<specular_roughness>0</specular_roughness><transmission_depth>0.5</transmission_depth>"
                 "<transmission_color red='0.4' green='0.6' blue='0.8'/>"
                 "<transmission_scatter red='0.3' green='0.2' blue='0.1'/><priority>1</priority></openpbr></openpbrs>"
                 "<mattes><matte><name>white</name><ka>0</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/></matte>"
                 "</mattes></materials><groups><group><name>g</name><objects><toruses><torus><center x='0.5' y='0' "
                 "z='0'/><axis x='0.2' y='1' z='0'/><sweptradius>0.5</sweptradius><tuberadius>0.2</tuberadius>"
                 "<material>white</material></torus></toruses></objects></group></groups><objects><instances><instance>"
                 "<group>g</group></instance></instances>" +
                     ball(-0.5, "glass") + ball(0.5, "milk") + "</objects>",
                 "<eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/>");
  const FloatPicture one = rendered(parsed_scene(scene), 1), two = rendered(parsed_scene(scene), 2);
  CHECK(identical(one, two));
  for (const Pixel& pixel : one.pixels()) {
    REQUIRE(pixel.green >= 0);
    REQUIRE(pixel.green < 0.25F);  // of 0.2 around
  }
}

TEST_CASE("paths through media in each other have the same bits however they are cut") {
  check_same_bits(basin("light", 16, true));
  check_same_bits(basin("photons", 20, false));
}

}  // namespace raytrace::test
