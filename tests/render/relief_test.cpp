// Normal maps and bumps turn shading normals as their textures say.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "raytrace/description/load_images.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/gltf.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

const std::string panel =
    "<rectangles><rectangle><corner x='-1' y='-1' z='0'/><edge1 x='2' y='0' z='0'/><edge2 x='0' y='2' z='0'/>"
    "<material>m</material></rectangle></rectangles>";
/// The same panel, with u to the left.
const std::string mirrored_panel =
    "<meshes><mesh><positions>-1 -1 0, 1 -1 0, 1 1 0, -1 1 0</positions><faces>0 1 2 3</faces>"
    "<uvs>1 0, 0 0, 0 1, 1 1</uvs><material>m</material></mesh></meshes>";

/// A texture of one colour.
std::string constant(double red, double green, double blue) {
  const std::string color =
      " red='" + std::to_string(red) + "' green='" + std::to_string(green) + "' blue='" + std::to_string(blue) + "'/>";
  return "<textures><checkers><checker><name>t</name><color1" + color + "<color2" + color +
         "</checker></checkers></textures>";
}

/// 8 x 8 pixels at the middle of the objects, from z = 5.
std::string relief_scene(const std::string& textures, const std::string& detail, const std::string& objects,
                         const std::string& integrator = "<normals/>") {
  return "<raytracer><viewplane><hres>8</hres><vres>8</vres><pixelsize>0.01</pixelsize></viewplane>"
         "<orthographiccamera><eye x='0.2' y='0.1' z='5'/><lookat x='0.2' y='0.1' z='0'/></orthographiccamera>"
         "<integrator>" +
         integrator +
         "</integrator><lights><directionallights><directionallight><direction x='1' y='0.5' z='1'/>"
         "<scaleradiance>3</scaleradiance><color red='1' green='1' blue='1'/></directionallight></directionallights>"
         "</lights>" +
         textures + "<materials><mattes><matte><name>m</name><ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/>" +
         detail + "</matte></mattes></materials><objects>" + objects + "</objects></raytracer>";
}

/// The mean of the normals in the picture.
Vec3d normal_of(const FloatPicture& picture) {
  Vec3d sum(0, 0, 0);
  for (const Pixel& pixel : picture.pixels())
    sum += Vec3d(2 * double{pixel.red} - 1, 2 * double{pixel.green} - 1, 2 * double{pixel.blue} - 1);
  return sum * (1 / static_cast<double>(picture.pixels().size()));
}

void check_normal(const FloatPicture& picture, const Vec3d& wanted, double tolerance = 1e-5) {
  const Vec3d got = normal_of(picture);
  INFO(got.x << " " << got.y << " " << got.z);
  CHECK(length(got - wanted) < tolerance);
}

}  // namespace

TEST_CASE("a normal map's x is along u, its y along v") {
  const double s = std::sin(0.5), c = std::cos(0.5);
  const std::string map = "<normalmap texture='t'/>";
  const std::string to_u = constant(0.5 + s / 2, 0.5, 0.5 + c / 2), to_v = constant(0.5, 0.5 + s / 2, 0.5 + c / 2);
  check_normal(rendered(relief_scene(to_u, map, panel)), {s, 0, c});
  check_normal(rendered(relief_scene(to_v, map, panel)), {0, s, c});
  check_normal(rendered(relief_scene(to_u, map, mirrored_panel)), {-s, 0, c});
  check_normal(rendered(relief_scene(to_v, map, mirrored_panel)), {0, s, c});

  // The frame is that of the set of texture coordinates by which the map is looked up.
  std::string two_sets = mirrored_panel, by_second = to_u;
  two_sets.insert(two_sets.find("<uvs>"), "<uvs2>0 0, 1 0, 1 1, 0 1</uvs2>");
  by_second.insert(by_second.find("</checker>"), "<uvset>2</uvset>");
  check_normal(rendered(relief_scene(to_u, map, two_sets)), {-s, 0, c});
  check_normal(rendered(relief_scene(by_second, map, two_sets)), {s, 0, c});

  const Vec3d half(s / 2, 0, c);
  check_normal(rendered(relief_scene(to_u, "<normalmap texture='t' strength='0.5'/>", panel)),
               half * (1 / length(half)));
}

TEST_CASE("however steep its relief, what is diffuse has the light that the map's normals say") {
  // Seen straight on, a mirror would show the inside where slopes are above 45 degrees.
  const Vec3d to_light = normalize(Vec3d(1, 0.5, 1));
  for (const double angle : {0.3, 0.9, 1.2})
    for (const int side : {-1, 1}) {
      const double s = side * std::sin(angle), c = std::cos(angle);
      std::string scene = relief_scene(constant(0.5 + s / 2, 0.5, 0.5 + c / 2), "", panel, "<path/>");
      const auto matte = scene.find("<mattes>"), end = scene.find("</mattes>") + 9;
      scene.replace(matte, end - matte,
                    "<openpbrs><openpbr><name>m</name><base_color red='1' green='1' blue='1'/><specular_weight>0"
                    "</specular_weight><normalmap texture='t'/></openpbr></openpbrs>");
      const FloatPicture picture = rendered(scene);
      const double relief_cosine = std::max(s * to_light.x + c * to_light.z, 0.0);
      const double g = relief_cosine > 0 ? std::min(to_light.z / (relief_cosine * c), 1.0) : 0;
      INFO("slope " << angle << ", side " << side);
      CHECK(double{picture.pixels()[0].green} ==
            Approx(3 / std::numbers::pi * relief_cosine * ((1 - g) * g + 1) * g).margin(2e-3));
    }
}

TEST_CASE("from behind, hills of a relief are hollows") {
  const double s = std::sin(0.5), c = std::cos(0.5);
  const auto from_behind = [](std::string scene) {
    const std::string eye = "<eye x='0.2' y='0.1' z='5'/>";
    return scene.replace(scene.find(eye), eye.size(), "<eye x='0.2' y='0.1' z='-5'/>");
  };
  const auto relief_of = [&](const std::string& texture, const std::string& detail) {
    return rendered(from_behind(relief_scene(texture, detail, panel)));
  };
  check_normal(relief_of(constant(0.5 + s / 2, 0.5, 0.5 + c / 2), "<normalmap texture='t'/>"), {-s, 0, -c});
  // A bump that rises with x, a square's edge after the other.
  const std::string steps =
      "<textures><noises><noise><name>t</name><scale>40</scale><octaves>1</octaves></noise></noises></textures>";
  const std::string bump = "<bump texture='t' height='40'/>";
  const Vec3d front = normal_of(rendered(relief_scene(steps, bump, panel))), back = normal_of(relief_of(steps, bump));
  REQUIRE(std::hypot(front.x, front.y) > 0.05);
  CHECK(length(front + back) < 0.02);  // slopes are differences of floats
}

TEST_CASE("relief on metal takes little of the light that it would reflect") {
  const std::string map =
      "<textures><noises><noise><name>t</name><scale>0.5</scale><octaves>2</octaves></noise></noises>"
      "</textures>";
  const std::string white = "<ce red='1' green='1' blue='1'/>";
  for (const std::string& material :
       {std::string("<conductors><conductor><name>m</name><cr red='1' green='1' blue='1'/><roughness>0.2</roughness>"
                    "<bump texture='t' height='0.4'/></conductor></conductors>"),
        std::string("<openpbrs><openpbr><name>m</name><base_color red='1' green='1' blue='1'/><base_metalness>1"
                    "</base_metalness><specular_roughness>0.2</specular_roughness><bump texture='t' height='0.4'/>"
                    "</openpbr></openpbrs>")}) {
    const FloatPicture picture = rendered(
        "<raytracer><viewplane><hres>16</hres><vres>16</vres><samples>16</samples></viewplane><camera><eye x='0' y='0' "
        "z='5'/><lookat x='0' y='0' z='0'/><fov>20</fov></camera><integrator><path/></integrator><lights>"
        "<environmentlights><environmentlight/></environmentlights></lights>" +
        map + "<materials>" + material +
        "</materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>m</material>"
        "</sphere></spheres></objects></raytracer>");
    INFO(material);
    CHECK(mean_green(picture) > 0.95);
  }
}

TEST_CASE("what a relief makes of a highlight is the same from afar") {
  // Facets that lean to the left and to the right, of which many are in a pixel.
  const double s = std::sin(0.3), c = std::cos(0.3);
  const auto color = [&](const char* name, double x) {
    return std::string("<") + name + " red='" + std::to_string(0.5 + x / 2) + "' green='0.5' blue='" +
           std::to_string(0.5 + c / 2) + "'/>";
  };
  const auto brightness = [&](const std::string& uvscale) {
    const std::string facets = "<textures><checkers><checker><name>t</name>" + color("color1", s) +
                               color("color2", -s) + "<uvscale x='" + uvscale +
                               "' y='1'/></checker></checkers></textures>";
    std::string scene = relief_scene(facets, "<normalmap texture='t'/>", panel, "<raycast/>");
    const std::string pixels = "<vres>8</vres>";
    scene.insert(scene.find(pixels) + pixels.size(), "<samples>64</samples>");
    return mean_green(rendered(scene));
  };
  const double left = brightness("0.001");  // one facet alone
  const double both = brightness("300");    // squares of 2/3 of a pixel
  INFO(left << ' ' << both);
  CHECK(std::abs(both / left - 1) > 0.1);
  CHECK(std::abs(brightness("600") / both - 1) < 0.02);
}

TEST_CASE("a file's own tangents say what a normal map's x and y are along") {
  const double s = std::sin(0.5), c = std::cos(0.5);
  const std::string map = "<normalmap texture='t'/>";
  const std::string to_u = constant(0.5 + s / 2, 0.5, 0.5 + c / 2), to_v = constant(0.5, 0.5 + s / 2, 0.5 + c / 2);
  const TemporaryFolder folder;
  const auto panel_with = [&](const std::vector<float>& tangent, const std::string& more = "") {
    GltfFile file;
    std::vector<float> tangents;
    for (int i = 0; i < 4; ++i) tangents.insert(tangents.end(), tangent.begin(), tangent.end());
    file.add(std::vector<float>{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, "VEC3", 5126, 4);
    file.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 5126, 4);
    file.add(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 5126, 4);
    file.add(tangents, "VEC4", 5126, 4);
    file.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 5123, 6);
    write_text(folder.file("panel.gltf"),
               file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                         R"({"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"TANGENT":3},"indices":4}]}])"));
    return "<meshes><mesh><file>" + folder.file("panel.gltf") + "</file>" + more +
           "<material>m</material></mesh></meshes>";
  };
  const auto check = [&](const std::string& texture, const std::string& object, const Vec3d& wanted) {
    check_normal(rendered(relief_scene(texture, map, object)), wanted);
  };
  check(to_u, panel_with({1, 0, 0, 1}), {s, 0, c});
  check(to_v, panel_with({1, 0, 0, 1}), {0, s, c});
  check(to_u, panel_with({0, 1, 0, 1}), {0, s, c});
  check(to_v, panel_with({0, 1, 0, 1}), {-s, 0, c});
  check(to_v, panel_with({0, 1, 0, -1}), {s, 0, c});
  const std::string mirrored = "<transform><scale x='-1' y='1' z='1'/></transform>";
  check(to_u, panel_with({1, 0, 0, 1}, mirrored), {-s, 0, c});
  check(to_v, panel_with({1, 0, 0, 1}, mirrored), {0, s, c});
  check(to_v, panel_with({0, 0, 0, 0}), {0, s, c});  // none
}

TEST_CASE("in instances, normal maps turn with the object") {
  const double s = std::sin(0.5), c = std::cos(0.5);
  std::string turned = panel;
  turned.insert(turned.find("<material>"), "<transform><rotate x='0' y='0' z='1' angle='90'/></transform>");
  check_normal(rendered(relief_scene(constant(0.5 + s / 2, 0.5, 0.5 + c / 2), "<normalmap texture='t'/>", turned)),
               {0, s, c});
}

TEST_CASE("a normal map of nothing but up leaves the picture as it is") {
  const std::string map = constant(0.5, 0.5, 1);
  const FloatPicture plain = rendered(relief_scene(map, "", panel, "<raycast/>"));
  const FloatPicture mapped = rendered(relief_scene(map, "<normalmap texture='t'/>", panel, "<raycast/>"));
  for (std::size_t i = 0; i < plain.pixels().size(); ++i)
    REQUIRE(difference(plain.pixels()[i], mapped.pixels()[i]) < 1e-5);
}

TEST_CASE("a bump's normal is that of the surface of its heights") {
  const TemporaryFolder folder;
  constexpr int width = 256;
  std::string ramp = "P5 " + std::to_string(width) + " 1 65535\n";
  for (int x = 0; x < width; ++x) {
    const int height = 65535 * x / (width - 1);
    ramp += {static_cast<char>(height / 256), static_cast<char>(height % 256)};
  }
  write_text(folder.path() / "ramp.pgm", ramp);

  const std::string textures = "<textures><images><image><name>t</name><file>" + folder.file("ramp.pgm") +
                               "</file><wrap>clamp</wrap></image></images></textures>";
  SceneDescription scene = parsed_scene(relief_scene(textures, "<bump texture='t' height='0.5'/>", panel));
  Diagnostics diagnostics("s");
  REQUIRE(load_images(scene, diagnostics, 1, {}));
  // The panel is 2 wide: it rises by 0.5 of 1 texel in 255 from one of 256 to the next.
  const Vec3d slope(-0.5 / 2 * 256 / 255, 0, 1);
  check_normal(rendered(scene), slope * (1 / length(slope)), 2e-3);
}

TEST_CASE("where relief turns a surface towards the light more than its shape is, the light ends softly") {
  // Light that grazes the panel from +x; the map leans towards it, so that the normal alone would leave a hard edge.
  const auto radiance = [&](double height) {
    const double s = std::sin(0.8), c = std::cos(0.8);
    std::string text =
        relief_scene(constant(0.5 + s / 2, 0.5, 0.5 + c / 2), "<normalmap texture='t'/>", panel, "<raycast/>");
    const std::string direction = "<direction x='1' y='0.5' z='1'/>";
    text.replace(text.find(direction), direction.size(), "<direction x='1' y='0' z='" + std::to_string(height) + "'/>");
    return double{rendered(text).pixels()[0].red};
  };
  CHECK(radiance(-0.01) == 0);
  double before = 0;
  for (const double height : {0.002, 0.02, 0.1, 0.4}) {
    const double now = radiance(height);
    CHECK(now > before);
    before = now;
  }
  CHECK(radiance(0.002) < 0.02);
}

}  // namespace raytrace::test
