// Rough glass: lights are drawn for it from both sides.
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

/// A ball of rough glass before the camera.
std::string frosted_ball(const std::string& glass, const std::string& more, const std::string& viewplane,
                         const std::string& lights = "") {
  return "<raytracer><viewplane><hres>24</hres><vres>24</vres><samples>256</samples>" + viewplane +
         "</viewplane><camera><eye x='0' y='0' z='4'/><lookat x='0' y='0' z='0'/><fov>24</fov></camera><integrator>"
         "<path><maxdepth>32</maxdepth></path></integrator>" +
         lights + "<materials><dielectrics><dielectric><name>frosted</name><ior>1.5</ior>" + glass +
         "</dielectric></dielectrics><emissives><emissive><name>lamp</name><ce red='9' green='9' blue='9'/></emissive>"
         "</emissives></materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius>"
         "<material>frosted</material></sphere>" +
         more + "</spheres></objects></raytracer>";
}

const std::string clouded =
    "<roughness>0.4</roughness><attenuationcolor red='0.5' green='0.5' blue='0.5'/>"
    "<attenuationdistance>1</attenuationdistance>";

}  // namespace

TEST_CASE("rough glass: a sky for which light is drawn is as bright behind it as one that paths meet") {
  const std::string sky =
      "<lights><environmentlights><environmentlight><color red='1' green='1' blue='1'/></environmentlight>"
      "</environmentlights></lights>";
  const std::string background = "<background red='1' green='1' blue='1'/>";
  for (const std::string& glass : {clouded, std::string("<roughness>0.4</roughness><thinwalled>true</thinwalled>")}) {
    const double drawn = mean_green(rendered(frosted_ball(glass, "", "", sky)));
    const double met = mean_green(rendered(frosted_ball(glass, "", background)));
    INFO(drawn << ", " << met);
    CHECK(std::abs(drawn / met - 1) < 0.006);
  }
}

TEST_CASE("rough glass: a small lamp in it or behind it lights it without much noise") {
  for (const std::string place : {"<center x='0' y='0.2' z='0'/>", "<center x='0' y='0' z='-1.6'/>"}) {
    const std::string text = frosted_ball(
        "<roughness>0.6</roughness>", "<sphere>" + place + "<radius>0.05</radius><material>lamp</material></sphere>",
        "<background red='0' green='0' blue='0'/>");
    const SceneDescription description = parsed_scene(text);
    const FloatPicture one = rendered(description, 1, {}, 1), other = rendered(description, 1, {}, 2);
    double square = 0;
    for (std::size_t i = 0; i < one.pixels().size(); ++i)
      square += std::pow(double{one.pixels()[i].green} - double{other.pixels()[i].green}, 2);
    const double noise = std::sqrt(square / 2 / static_cast<double>(one.pixels().size()));
    INFO("noise " << noise << ", mean " << mean_green(one));
    CHECK(noise < 0.15 * mean_green(one));
  }
}

}  // namespace raytrace::test
