// Shining surfaces that move while the shutter is open: light is drawn from them where they are at the ray's time.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"

namespace raytrace::test {

namespace {

const std::string open_shutter = "<shutteropen>-0.5</shutteropen><shutterclose>0.5</shutterclose>";

/// A corner of a grey room; of objects, M is the lamps' material.
struct LampRoom {
  std::string objects, groups = {};
  std::string lamp = {};  ///< more of that material
  std::string path = {};  ///< of the integrator
  std::string materials = {}, textures = {};
  int maxdepth = 2;

  std::string text(int samples, const std::string& shutter = {}) const {
    return "<raytracer><viewplane><hres>16</hres><vres>16</vres><samples>" + std::to_string(samples) +
           "</samples></viewplane><camera><eye x='0' y='1' z='4'/><lookat x='0' y='-0.4' z='0'/><fov>50</fov>" +
           shutter + "</camera><integrator><path><maxdepth>" + std::to_string(maxdepth) + "</maxdepth>" + path +
           "</path></integrator>" + textures +
           "<materials><mattes><matte><name>grey</name><ka>0</ka><kd>0.6</kd><cd red='1' green='1' blue='1'/></matte>"
           "</mattes><emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/>"
           "<scaleradiance>4</scaleradiance>" +
           lamp + "</emissive></emissives>" + materials +
           "</materials><objects><planes><plane><point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/>"
           "<material>grey</material></plane><plane><point x='0' y='0' z='-1.5'/><normal x='0' y='0' z='1'/>"
           "<material>grey</material></plane></planes>" +
           with_lamp(objects) + "</objects><groups>" + with_lamp(groups) + "</groups></raytracer>";
  }

  static std::string with_lamp(std::string text) {
    for (std::size_t at = 0; (at = text.find('M', at)) != std::string::npos;)
      text.replace(at, 1, "<material>lamp</material>");
    return text;
  }
};

/// The means of 4 x 4 blocks of a picture.
using Blocks = std::array<double, 16>;
void add_blocks_of(const FloatPicture& picture, double share, Blocks& blocks) {
  for (std::size_t i = 0; i < picture.pixels().size(); ++i)
    blocks[i / 16 / 4 * 4 + i % 16 / 4] += share * double{picture.pixels()[i].green} / 16;
}

/// How far the picture with an open shutter is from the mean of those of its moments: of the mean, and of the block
/// where it is farthest, of the brightest block.
struct Apart {
  double mean, worst;
};
Apart apart_from_moments(const LampRoom& room, int samples) {
  Blocks open{}, still{};
  add_blocks_of(rendered(parsed_scene(room.text(samples, open_shutter)), 2), 1, open);
  constexpr int moments = 32;
  for (int i = 0; i < moments; ++i) {
    const auto seed = static_cast<std::uint64_t>(i) + 1;
    const SceneDescription then = at_moment(room.text(std::max(samples / moments, 1)), -0.5 + (i + 0.5) / moments);
    add_blocks_of(rendered(then, 2, {}, seed), 1.0 / moments, still);
  }
  double sum_open = 0, sum_still = 0, worst = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    sum_open += open[i];
    sum_still += still[i];
    worst = std::max(worst, std::abs(open[i] - still[i]));
  }
  return {sum_open / sum_still - 1, worst / *std::max_element(still.begin(), still.end())};
}

const std::string slides = keys("translate", "x='-1' y='0' z='0'", "x='1' y='0.5' z='0.4'");
const std::string turns = keys("rotate", "x='0.3' y='0.2' z='1' angle='-50'", "x='0.3' y='0.2' z='1' angle='70'");
/// Out of the camera's view: a bright edge would need more moments.
const std::string out_of_view = "<translate x='0' y='2.4' z='0.3'/>";
std::string under(const std::string& transform) { return "<transform>" + transform + "</transform>"; }

/// A panel, a ball, a disk, a box and a quad in a group.
const std::string group_of_lamps =
    "<group><name>lamps</name><objects><rectangles><rectangle><corner x='-0.3' y='0.2' z='-0.2'/>"
    "<edge1 x='0.4' y='0' z='0'/><edge2 x='0' y='0' z='0.4'/>M</rectangle></rectangles><spheres><sphere>"
    "<center x='0.3' y='0' z='0.2'/><radius>0.12</radius>M</sphere></spheres><disks><disk><center x='-0.4' y='0' "
    "z='0'/>"
    "<normal x='-0.3' y='-1' z='0.2'/><radius>0.2</radius>M</disk></disks><boxes><box><min x='-0.1' y='-0.2' z='0.3'/>"
    "<max x='0.1' y='-0.1' z='0.5'/>M</box></boxes><meshes><mesh><positions>-0.2 -0.4 -0.2  0.2 -0.4 -0.2  "
    "0.2 -0.3 0.2  -0.2 -0.5 0.2</positions><faces>0 1 2 3</faces>M</mesh></meshes></objects></group>";
std::string lamps_under(const std::string& transform) {
  return "<instances><instance><group>lamps</group>" + under(transform) + "</instance></instances>";
}

const LampRoom moving_lamps[] = {
    {"<spheres><sphere>" + keys("center", "x='-1' y='1.8' z='0.2'", "x='1' y='2.2' z='0.5'") +
     "<radius>0.2</radius>M</sphere></spheres>"},
    {"<boxes><box><min x='-0.3' y='-0.1' z='-0.1'/><max x='0.3' y='0.1' z='0.2'/>M" + under(turns + out_of_view) +
     "</box></boxes>"},
    {"<rectangles><rectangle><corner x='-0.3' y='0' z='-0.2'/><edge1 x='0.6' y='0' z='0'/><edge2 x='0' y='0' "
     "z='0.4'/>M" +
     under(turns + slides + out_of_view) + "</rectangle></rectangles>"},
    {lamps_under("<scale x='1.4' y='1.4' z='1.4'/>" + slides + out_of_view), group_of_lamps},
    {lamps_under("<scale x='-1.3' y='0.6' z='1'/>" + turns + slides + out_of_view), group_of_lamps},
    {lamps_under(keys("scale", "x='0.4' y='0.6' z='1'", "x='1.6' y='1.2' z='0.5'") + turns + out_of_view),
     group_of_lamps},
};

}  // namespace

TEST_CASE("a lamp that moves is as bright as at its moments on the mean") {
  const int samples = is_sanitized ? 64 : 1024;
  for (std::size_t i = 0; i < std::size(moving_lamps); ++i) {
    const Apart apart = apart_from_moments(moving_lamps[i], samples);
    INFO("lamp " << i << ": " << apart.mean << ", at worst " << apart.worst);
    CHECK(std::abs(apart.mean) < (is_sanitized ? 0.1 : 0.005));
    CHECK(apart.worst < (is_sanitized ? 0.2 : 0.02));
  }
}

TEST_CASE("all shapes that move are as bright where they are drawn as where they are met") {
  // Under such a map those that stand still are left to chance, the torus and the bands: they have no moments to
  // compare with that have little noise. Rays pass a surface of some opacity, so no light is drawn from it.
  const std::string moves = under("<scale x='1.4' y='0.7' z='1'/>" + turns + slides);
  LampRoom room{
      "<cylinders><cylinder><bottom x='-0.4' y='0' z='0'/><top x='0.4' y='0.1' z='0.2'/><radius>0.2</radius>"
      "<caps>true</caps>M" +
      moves +
      "</cylinder></cylinders><cones><cone><bottom x='0' y='-0.8' z='0'/><top x='0.1' y='-0.2' z='0'/>"
      "<radius>0.4</radius><topradius>0.1</topradius><caps>true</caps>M" +
      moves +
      "</cone></cones><toruses><torus><center x='0' y='0.6' z='0'/><axis x='0.2' y='1' z='0'/>"
      "<sweptradius>0.4</sweptradius><tuberadius>0.15</tuberadius>M" +
      moves +
      "</torus></toruses><annuli><annulus><center x='0' y='-0.5' z='0'/><normal x='0.3' y='-1' z='0'/>"
      "<innerradius>0.3</innerradius><outerradius>0.6</outerradius>M" +
      moves + "</annulus></annuli>"};
  const double drawn = mean_green(rendered(parsed_scene(room.text(is_sanitized ? 64 : 1024, open_shutter)), 2));
  room.lamp = "<opacity>0.9999999</opacity>";
  const double met = mean_green(rendered(parsed_scene(room.text(is_sanitized ? 64 : 4096, open_shutter)), 2));
  INFO(drawn << ", by chance " << met);
  CHECK(std::abs(drawn / met - 1) < (is_sanitized ? 0.1 : 0.02));
}

TEST_CASE("a lamp with a texture that moves is as bright as at its moments on the mean") {
  LampRoom room{lamps_under("<scale x='-1.3' y='0.8' z='1'/>" + turns + slides + out_of_view), group_of_lamps};
  const std::string uvs = "</faces><uvs>0 0  1 0  1 1  0 1</uvs>";
  room.groups.replace(room.groups.find("</faces>"), 8, uvs);
  room.textures =
      "<textures><checkers><checker><name>squares</name><color1 red='1' green='1' blue='1'/>"
      "<color2 red='0' green='0' blue='0'/><uvscale x='3' y='2'/></checker></checkers></textures>";
  room.lamp = "<ce red='1' green='1' blue='1' texture='squares'/>";
  const auto textured = [&](int samples, const std::string& shutter) {
    std::string text = room.text(samples, shutter);
    const std::string plain = "<ce red='1' green='1' blue='1'/><scaleradiance>";
    text.erase(text.find(plain), plain.size() - 15);
    return text;
  };
  REQUIRE(!parsed_scene(textured(1, open_shutter)).groups.empty());
  const int samples = is_sanitized ? 32 : 512, moments = 32;
  const double open = mean_green(rendered(parsed_scene(textured(samples, open_shutter)), 2));
  double still = 0;
  for (int i = 0; i < moments; ++i) {
    const auto seed = static_cast<std::uint64_t>(i) + 1;
    const SceneDescription then = at_moment(textured(samples / moments, ""), -0.5 + (i + 0.5) / moments);
    still += mean_green(rendered(then, 2, {}, seed)) / moments;
  }
  INFO(open << ", at its moments " << still);
  CHECK(std::abs(open / still - 1) < (is_sanitized ? 0.1 : 0.01));
}

TEST_CASE("a small lamp that moves has far less noise where it is drawn than where it is met by chance") {
  LampRoom room{"<spheres><sphere>" + keys("center", "x='-1' y='1.6' z='0'", "x='1' y='1.6' z='0.3'") +
                "<radius>0.05</radius>M</sphere></spheres>"};
  const FloatPicture many = rendered(parsed_scene(room.text(1024, open_shutter)), 2);
  const auto squared_error = [&](const FloatPicture& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.pixels().size(); ++i)
      sum += std::pow(double{picture.pixels()[i].green} - double{many.pixels()[i].green}, 2);
    return sum;
  };
  const double drawn = squared_error(rendered(parsed_scene(room.text(64, open_shutter)), 2));
  room.lamp = "<opacity>0.9999999</opacity>";
  const double met = squared_error(rendered(parsed_scene(room.text(64, open_shutter)), 2));
  INFO(drawn << ", by chance " << met);
  CHECK(drawn < met / 20);
}

TEST_CASE("light paths and photons start at lamps where they are at their time") {
  for (const std::string way : {"light", "photons"}) {
    LampRoom room{
        "<spheres><sphere><center x='0' y='-0.3' z='0.3'/><radius>0.4</radius><material>glass</material></sphere>"
        "</spheres>" +
            lamps_under("<scale x='0.8' y='0.8' z='0.8'/>" + slides + out_of_view),
        group_of_lamps};
    room.materials = "<dielectrics><dielectric><name>glass</name><ior>1.5</ior></dielectric></dielectrics>";
    room.path = "<caustics>" + way + "</caustics>";
    room.maxdepth = 5;
    const Apart apart = apart_from_moments(room, is_sanitized ? 32 : 512);
    INFO(way << ": " << apart.mean << ", at worst " << apart.worst);
    CHECK(std::abs(apart.mean) < (is_sanitized ? 0.1 : 0.01));
    CHECK(apart.worst < (is_sanitized ? 0.3 : 0.04));
  }
}

TEST_CASE("light paths know what their lamp is in at their time") {
  // A lamp in clear glass, which is in dark glass when the shutter opens. That slides away, and so may the lamp.
  const bool moves = GENERATE(true, false);
  const std::string ball = "<sphere><center x='0' y='0' z='0'/><radius>";
  LampRoom room{
      lamps_under((moves ? keys("translate", "x='0' y='0' z='0'", "x='0.2' y='0' z='0'") : "") + out_of_view) +
          "<spheres>" + ball + "0.5</radius><material>dark</material>" +
          under(keys("translate", "x='-1' y='0' z='0'", "x='3' y='0' z='0'") + out_of_view) + "</sphere></spheres>",
      "<group><name>lamps</name><objects><spheres>" + ball + "0.2</radius>M</sphere>" + ball +
          "0.3</radius><material>clear</material></sphere></spheres></objects></group>"};
  room.materials =
      "<dielectrics><dielectric><name>clear</name><ior>1.2</ior></dielectric><dielectric><name>dark</name>"
      "<ior>1.2</ior><attenuationcolor red='0.1' green='0.1' blue='0.1'/><attenuationdistance>0.1</attenuationdistance>"
      "</dielectric></dielectrics>";
  room.path = "<caustics>light</caustics>";
  room.maxdepth = 5;
  const Apart apart = apart_from_moments(room, is_sanitized ? 32 : 1024);
  INFO((moves ? "moving: " : "at rest: ") << apart.mean << ", at worst " << apart.worst);
  CHECK(std::abs(apart.mean) < (is_sanitized ? 0.3 : 0.05));
}

TEST_CASE("fog gets the light of lamps that move") {
  LampRoom room{lamps_under("<scale x='0.7' y='0.7' z='0.7'/>" + turns + slides + out_of_view) +
                    "<boxes><box><min x='-6' y='-1' z='-1.5'/><max x='6' y='6' z='6'/><material>haze</material></box>"
                    "</boxes>",
                group_of_lamps};
  room.materials = "<fogs><fog><name>haze</name><meanfreepath>4</meanfreepath></fog></fogs>";
  const Apart apart = apart_from_moments(room, is_sanitized ? 32 : 1024);
  INFO(apart.mean << ", at worst " << apart.worst);
  CHECK(std::abs(apart.mean) < (is_sanitized ? 0.1 : 0.01));
  CHECK(apart.worst < (is_sanitized ? 0.3 : 0.03));
}

TEST_CASE("the bits of light from what moves do not depend on how the work is cut") {
  LampRoom room{moving_lamps[4].objects + moving_lamps[0].objects +
                    "<disks><disk><center x='1' y='1.5' z='0'/><normal x='0' y='-1' z='0'/><radius>0.3</radius>M</disk>"
                    "</disks><spheres><sphere><center x='0' y='-0.3' z='0.3'/><radius>0.4</radius>"
                    "<material>glass</material></sphere></spheres>",
                group_of_lamps};
  room.materials = "<dielectrics><dielectric><name>glass</name><ior>1.5</ior></dielectric></dielectrics>";
  room.path = GENERATE(std::string(), std::string("<caustics>light</caustics>"));
  room.maxdepth = 3;
  check_same_bits(parsed_scene(room.text(8, open_shutter)));
}

}  // namespace raytrace::test
