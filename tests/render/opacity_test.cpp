// Surfaces that some rays pass: how many, and that it does not depend on how the picture is made.
#include <cmath>
#include <string>

#include "raytrace/description/load_images.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

struct Crossed {
  const char* group;
  const char* element;  ///< all of it but its material
  int crossings;        ///< of its surface by rays close to the z axis
};

const Crossed crossed_shapes[] = {
    {"planes", "<plane><point x='0' y='0' z='1'/><normal x='0' y='0' z='1'/>", 1},
    {"triangles",
     "<triangle><vertexposition1 x='-4' y='-4' z='1'/><vertexposition2 x='4' y='-4' z='1'/>"
     "<vertexposition3 x='0' y='4' z='1'/>",
     1},
    {"spheres", "<sphere><center x='0' y='0' z='0'/><radius>1</radius>", 2},
    {"spheres",
     "<sphere><center x='0' y='0' z='0'/><radius>1</radius><transform><scale x='1' y='2' z='1'/></transform>", 2},
    {"cylinders", "<cylinder><bottom x='0' y='-1' z='0'/><top x='0' y='1' z='0'/><radius>1</radius>", 2},
    {"cylinders", "<cylinder><bottom x='0' y='0' z='-1'/><top x='0' y='0' z='1'/><radius>1</radius><caps>true</caps>",
     2},
    {"toruses", "<torus><axis x='0' y='1' z='0'/><sweptradius>0.75</sweptradius><tuberadius>0.25</tuberadius>", 4},
    {"disks", "<disk><center x='0' y='0' z='1'/><normal x='0' y='0' z='1'/><radius>2</radius>", 1},
    {"rectangles", "<rectangle><corner x='-1' y='-1' z='1'/><edge1 x='2' y='0' z='0'/><edge2 x='0' y='2' z='0'/>", 1},
    {"boxes", "<box><min x='-1' y='-1' z='-1'/><max x='1' y='1' z='1'/>", 2},
    {"cones",
     "<cone><bottom x='0' y='-1' z='0'/><top x='0' y='1' z='0'/><radius>1.5</radius><topradius>0.5</topradius>", 2},
    {"annuli",
     "<annulus><center x='2' y='0' z='1'/><normal x='0' y='0' z='1'/><innerradius>1</innerradius>"
     "<outerradius>3</outerradius>",
     1},
    {"meshes", "<mesh><positions>-4 -4 1, 4 -4 1, 0 4 1, -4 -4 0, 4 -4 0, 0 4 0</positions><faces>0 1 2, 3 4 5</faces>",
     2},
    {"meshes", "<mesh><positions>-4 -4 1, 4 -4 1, 4 4 1, -4 4 1</positions><faces>0 1 2 3</faces>", 1}};

std::string object(const Crossed& shape, const std::string& material = "veil") {
  const std::string element(shape.element);
  const std::string end = "</" + element.substr(1, element.find('>') - 1) + ">";
  return "<" + std::string(shape.group) + ">" + element + "<material>" + material + "</material>" + end + "</" +
         shape.group + ">";
}

std::string material(const std::string& name, const std::string& opacity, double kd = 0) {
  return "<matte><name>" + name + "</name><ka>1</ka><kd>" + std::to_string(kd) +
         "</kd><cd red='1' green='1' blue='1'/>" + opacity + "</matte>";
}

/// 16 x 16 pixels about the z axis, from z = 5, over a black background.
SceneDescription axial_scene(const std::string& materials, const std::string& objects, const std::string& rest = {}) {
  return parsed_scene(
      "<raytracer><viewplane><hres>16</hres><vres>16</vres><pixelsize>0.01</pixelsize><samples>64</samples></viewplane>"
      "<orthographiccamera><eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/></orthographiccamera>" +
      rest + "<materials><mattes>" + materials + "</mattes></materials><objects>" + objects + "</objects></raytracer>");
}

constexpr double all_samples = 16 * 16 * 64;
const std::string white_ambient =
    "<ambientlight><scaleradiance>1</scaleradiance><color red='1' green='1' blue='1'/></ambientlight>";
const std::string light_from_camera =
    "<directionallights><directionallight><direction x='0' y='0' z='1'/><scaleradiance>1</scaleradiance>"
    "<color red='1' green='1' blue='1'/><shadows>true</shadows></directionallight></directionallights>";

double mean(const FloatPicture& picture) {
  double sum = 0;
  for (const Pixel& pixel : picture.pixels()) sum += double{pixel.red};
  return sum / static_cast<double>(picture.pixels().size());
}

/// 4.5 standard deviations of the share of all samples.
double tolerance(double share) { return 4.5 * std::sqrt(share * (1 - share) / all_samples); }

}  // namespace

TEST_CASE("rays meet each crossing of a surface with the chance that its opacity is") {
  constexpr double opacity = 0.3;
  for (const Crossed& shape : crossed_shapes) {
    const SceneDescription scene = axial_scene(material("veil", "<opacity>0.3</opacity>"), object(shape),
                                               "<lights>" + white_ambient + "</lights>");
    const double share = 1 - std::pow(1 - opacity, shape.crossings);
    for (const std::string& isa : usable_isas()) {
      INFO(shape.element << ", " << isa);
      CHECK(std::abs(mean(rendered(scene, 1, isa)) - share) < tolerance(share));
    }
  }
}

TEST_CASE("of a pixel's samples, the share that its opacity is meets a surface: their numbers are stratified") {
  const SceneDescription one = axial_scene(material("veil", "<opacity>0.25</opacity>"), object(crossed_shapes[0]),
                                           "<lights>" + white_ambient + "</lights>");
  for (const std::string& isa : usable_isas()) {
    const FloatPicture picture = rendered(one, 1, isa);
    for (const Pixel& pixel : picture.pixels()) REQUIRE(pixel.red == 0.25f);
  }
}

TEST_CASE("the numbers of two surfaces have nothing to do with each other") {
  const std::string behind =
      "<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='0' z='1'/><material>other</material></plane></planes>";
  const SceneDescription two =
      axial_scene(material("veil", "<opacity>0.5</opacity>") + material("other", "<opacity>0.5</opacity>"),
                  object(crossed_shapes[13]) + behind, "<lights>" + white_ambient + "</lights>");
  const FloatPicture picture = rendered(two);
  double squares = 0;
  for (const Pixel& pixel : picture.pixels()) squares += std::pow(double{pixel.red} - 0.75, 2);
  CHECK(std::abs(mean(picture) - 0.75) < tolerance(0.75));
  // Of two samples that follow each other one passes each of them, so of 32 pairs half pass both: 32 / 4. In the same
  // order all or none would pass the second, and without strata it would be 64 * 0.25 * 0.75 = 12.
  const double variance = squares / static_cast<double>(picture.pixels().size()) * 64 * 64;
  CHECK(std::abs(variance - 8) < 3);
}

TEST_CASE("in instances, too, by the instance's own material") {
  const std::string group = "<groups><group><name>g</name><objects>" + object(crossed_shapes[2], "wall") +
                            object(crossed_shapes[13], "wall") + "</objects></group></groups>";
  const SceneDescription scene =
      axial_scene(material("veil", "<opacity>0.2</opacity>") + material("wall", ""),
                  "<instances><instance><group>g</group><material>veil</material><transform>"
                  "<rotate x='0' y='0' z='1' angle='30'/></transform></instance></instances>",
                  "<lights>" + white_ambient + "</lights>" + group);
  const double share = 1 - std::pow(0.8, 3);
  CHECK(std::abs(mean(rendered(scene)) - share) < tolerance(share));
}

TEST_CASE("spheres of a cloud have the opacity of the cloud's material, single ones and meshes beside them their own") {
  const TemporaryFolder folder;
  write_text(folder.file("a.ply"),
             "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n0 0 0\n0 0 -3\n");
  const std::string cloud = "<sphereclouds><spherecloud><file>" + folder.file("a.ply") +
                            "</file><radius>1</radius><material>veil</material></spherecloud></sphereclouds>";
  const std::string beside =
      "<spheres><sphere><center x='9' y='0' z='0'/><radius>1</radius><material>wall</material>"
      "</sphere></spheres>" +
      object(crossed_shapes[13], "glass");
  const SceneDescription scene = axial_scene(
      material("veil", "<opacity>0.2</opacity>") + material("wall", "") + material("glass", "<opacity>0</opacity>"),
      cloud + beside, "<lights>" + white_ambient + "</lights>");
  const double share = 1 - std::pow(0.8, 4);
  CHECK(std::abs(mean(rendered(scene)) - share) < tolerance(share));
}

TEST_CASE("a shadow ray's chance has nothing to do with the camera ray's, nor with that of another light") {
  const std::string lights = GENERATE(as<std::string>{}, "one", "two");
  std::string all = light_from_camera;
  if (lights == "two") all += light_from_camera;
  const std::string floor =
      "<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='0' z='1'/>"
      "<material>floor</material></plane></planes>";
  SceneDescription scene = axial_scene(material("veil", "<opacity>0.5</opacity>") + material("floor", "", 1),
                                       floor + object(crossed_shapes[7]), "<lights>" + all + "</lights>");
  // A quarter of the samples sees the floor lit by a light: through the disk on both ways.
  const double lit = (lights == "one" ? 1 : 2) / 3.14159265358979;
  const double share = mean(rendered(scene)) / lit;
  CHECK(std::abs(share - 0.25) < tolerance(0.25));
}

TEST_CASE("the shadows of meshes have the holes of an opacity's image, where their texture coordinates have them") {
  const TemporaryFolder folder;
  write_text(folder.path() / "holes.pgm", std::string("P5 4 1 255\n") + '\0' + "\xff\xff" + '\0');
  const std::string positions = "<positions>-1 -1 6, 1 -1 6, 1 1 6, -1 1 6</positions>", upright = "0 0, 1 0, 1 1, 0 1",
                    turned = "0 0, 0 1, 1 1, 1 0", half = "0 0, 0.5 0, 0.5 1, 0 1";
  struct Case {
    const char* name;
    std::string mesh;
    bool by_second;
    std::string lit;  ///< whether each quarter is, from left to right
  };
  const std::string quad = "<faces>0 1 2 3</faces>", two = "<faces>0 1 2, 0 2 3</faces>";
  const auto uvs = [](const std::string& first, const std::string& second = "") {
    return "<uvs>" + first + "</uvs>" + (second.empty() ? "" : "<uvs2>" + second + "</uvs2>");
  };
  const std::string mirror = "<transform><scale x='-1' y='1' z='1'/></transform>";
  for (const Case& c : {Case{"a quad", positions + quad + uvs(upright), false, "1001"},
                        {"triangles", positions + two + uvs(upright), false, "1001"},
                        {"half of the image", positions + two + uvs(half), false, "1100"},
                        {"mirrored", positions + two + uvs(half) + mirror, false, "0011"},
                        {"a mirrored quad", positions + quad + uvs(half) + mirror, false, "0011"},
                        {"the second set", positions + two + uvs(turned, half), true, "1100"},
                        {"no coordinates, a quad's own", positions + quad, false, "1001"}}) {
    INFO(c.name);
    const std::string textures = "<textures><images><image><name>t</name><file>" + folder.file("holes.pgm") +
                                 "</file><filter>nearest</filter>" + (c.by_second ? "<uvset>2</uvset>" : "") +
                                 "</image></images></textures>";
    const std::string mesh = "<mesh>" + c.mesh + "<material>veil</material></mesh>";
    for (const bool in_group : {false, true}) {
      INFO((in_group ? "in an instance" : "in the world"));
      const std::string group =
          "<groups><group><name>g</name><objects><meshes>" + mesh + "</meshes></objects></group></groups>";
      SceneDescription scene = parsed_scene(
          "<raytracer><viewplane><hres>16</hres><vres>4</vres><pixelsize>0.125</pixelsize><samples>16</samples>"
          "</viewplane><orthographiccamera><eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/></orthographiccamera>"
          "<lights>" +
          light_from_camera + "</lights>" + textures + "<materials><mattes>" +
          material("veil", "<opacity texture='t' channel='red'>1</opacity>") + material("floor", "", 1) +
          "</mattes></materials>" + (in_group ? group : "") +
          "<objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='0' z='1'/><material>floor</material>"
          "</plane></planes>" +
          (in_group ? "<instances><instance><group>g</group></instance></instances>"
                    : "<meshes>" + mesh + "</meshes>") +
          "</objects></raytracer>");
      Diagnostics diagnostics("s");
      REQUIRE(load_images(scene, diagnostics, 1, {}));
      const FloatPicture picture = rendered(scene);
      for (std::size_t i = 0; i < 16; ++i) {
        INFO("column " << i);
        CHECK((picture.pixels()[i].red > 0.1F) == (c.lit[i / 4] == '1'));
      }
    }
  }
}

TEST_CASE("what rays pass does not depend on threads, samples at once, or how the picture is cut") {
  std::string text = busy_scene(61, 47, 16);
  // Every other material is a veil.
  int number = 0;
  for (const std::string& end : {std::string("</matte>"), std::string("</phong>")})
    for (std::size_t at = text.find(end); at != std::string::npos; at = text.find(end, at)) {
      const std::string veil = number++ % 2 == 0 ? "<opacity>0.6</opacity>" : "";
      text.insert(at, veil);
      at += veil.size() + end.size();
    }
  REQUIRE(number >= 2);
  const SceneDescription description = parsed_scene(text);
  check_same_bits(description);
}

}  // namespace raytrace::test
