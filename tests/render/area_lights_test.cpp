// Light drawn from shining surfaces: against closed forms, and against paths that meet them by chance.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

constexpr double pi = 3.14159265358979;

struct Lamp {
  const char* name;
  const char* objects;
};

/// One of each shape that shines, within 1 of the origin; instances of them, too.
const Lamp lamps[] = {
    {"sphere", "<spheres><sphere><center x='0' y='0.2' z='0'/><radius>0.4</radius>M</sphere></spheres>"},
    {"triangle",
     "<triangles><triangle><vertexposition1 x='-0.5' y='0' z='0'/><vertexposition2 x='0' y='0.1' z='0.6'/>"
     "<vertexposition3 x='0.5' y='0.2' z='-0.2'/>M</triangle></triangles>"},
    {"rectangle",
     "<rectangles><rectangle><corner x='-0.5' y='0.2' z='-0.3'/><edge1 x='1' y='0' z='0'/>"
     "<edge2 x='0.2' y='0.1' z='0.6'/>M</rectangle></rectangles>"},
    {"box", "<boxes><box><min x='-0.4' y='0' z='-0.2'/><max x='0.2' y='0.3' z='0.5'/>M</box></boxes>"},
    {"disk",
     "<disks><disk><center x='0' y='0.1' z='0'/><normal x='0.3' y='-1' z='0'/><radius>0.5</radius>M</disk>"
     "</disks>"},
    {"annulus",
     "<annuli><annulus><center x='0' y='0.1' z='0'/><normal x='0.3' y='-1' z='0'/>"
     "<innerradius>0.3</innerradius><outerradius>0.6</outerradius>M</annulus></annuli>"},
    {"cylinder",
     "<cylinders><cylinder><bottom x='-0.4' y='0' z='0'/><top x='0.4' y='0.1' z='0.2'/>"
     "<radius>0.2</radius><caps>true</caps>M</cylinder></cylinders>"},
    {"cone",
     "<cones><cone><bottom x='0' y='-0.2' z='0'/><top x='0.1' y='0.4' z='0'/><radius>0.4</radius>"
     "<topradius>0.1</topradius><caps>true</caps>M</cone></cones>"},
    {"torus",
     "<toruses><torus><center x='0' y='0.1' z='0'/><axis x='0.2' y='1' z='0'/><sweptradius>0.4</sweptradius>"
     "<tuberadius>0.15</tuberadius>M</torus></toruses>"},
    {"mesh of quads",
     "<meshes><mesh><positions>-0.5 0.2 -0.5  0.5 0.2 -0.5  0.5 0.3 0.5  -0.5 0 0.4</positions>"
     "<faces>0 1 2 3</faces>M</mesh></meshes>"},
    {"mirrored box",
     "<boxes><box><min x='-0.4' y='0' z='-0.2'/><max x='0.2' y='0.3' z='0.5'/>M<transform>"
     "<scale x='-1' y='0.5' z='1'/><rotate x='0' y='0' z='1' angle='20'/></transform></box></boxes>"},
    {"flattened sphere",
     "<spheres><sphere><center x='0' y='0' z='0'/><radius>0.5</radius>M<transform>"
     "<scale x='1' y='0.4' z='1'/></transform></sphere></spheres>"},
    {"stretched, mirrored sphere",
     "<spheres><sphere><center x='0.1' y='0' z='0'/><radius>0.3</radius>M<transform>"
     "<scale x='-0.5' y='2' z='1'/><rotate x='1' y='1' z='0.3' angle='40'/></transform></sphere></spheres>"},
    {"elliptical disk",
     "<disks><disk><center x='0' y='0.1' z='0'/><normal x='0.3' y='-1' z='0'/><radius>0.5</radius>M<transform>"
     "<scale x='1.4' y='1' z='0.5'/></transform></disk></disks>"},
    {"skewed, mirrored annulus",
     "<annuli><annulus><center x='0' y='0.1' z='0'/><normal x='0.3' y='-1' z='0.2'/><innerradius>0.2</innerradius>"
     "<outerradius>0.8</outerradius>M<transform><scale x='-0.7' y='0.7' z='1.2'/>"
     "<rotate x='0.2' y='1' z='0' angle='35'/><scale x='1' y='1' z='0.8'/></transform></annulus></annuli>"},
};

/// A grey room's corner about the lamp. emissive: more of the lamp's material.
std::string room(std::string objects, const std::string& emissive, int samples, const std::string& integrator) {
  for (std::size_t at = 0; (at = objects.find('M', at)) != std::string::npos;)
    objects.replace(at, 1, "<material>lamp</material>");
  return "<raytracer><viewplane><hres>8</hres><vres>8</vres><samples>" + std::to_string(samples) +
         "</samples></viewplane><camera><eye x='0' y='1' z='4'/><lookat x='0' y='-0.4' z='0'/><fov>50</fov></camera>"
         "<integrator><path><maxdepth>2</maxdepth>" +
         integrator +
         "</path></integrator><materials><mattes><matte><name>grey</name><ka>0</ka><kd>0.6</kd>"
         "<cd red='1' green='1' blue='1'/></matte></mattes><emissives><emissive><name>lamp</name>"
         "<ce red='1' green='1' blue='1'/><scaleradiance>2</scaleradiance>" +
         emissive +
         "</emissive></emissives></materials><objects><planes><plane><point x='0' y='-1' z='0'/>"
         "<normal x='0' y='1' z='0'/><material>grey</material></plane><plane><point x='0' y='0' z='-1.5'/>"
         "<normal x='0' y='0' z='1'/><material>grey</material></plane></planes>" +
         objects + "</objects></raytracer>";
}

}  // namespace

TEST_CASE("drawn light is as bright as light that paths meet by chance") {
  // A sanitizer looks at what is read and written, not at light: a mean of few samples there, and not so sure.
  const int samples = is_sanitized ? 512 : 16384;
  const double bound = is_sanitized ? 0.2 : 0.02;
  for (const Lamp& lamp : lamps) {
    const bool two_sided = std::string(lamp.name) == "triangle" || std::string(lamp.name) == "rectangle";
    const std::string sides = two_sided ? "<twosided>true</twosided>" : "";
    // Rays pass a surface of some opacity, so no light is drawn from it: of one in so many millions.
    const double by_chance =
        mean_green(rendered(parsed_scene(room(lamp.objects, sides + "<opacity>0.9999999</opacity>", samples, "")), 2));
    for (const std::string sampling : {"tree", "uniform"}) {
      const double drawn = mean_green(rendered(parsed_scene(room(lamp.objects, sides, is_sanitized ? 64 : 256,
                                                                 "<lightsampling>" + sampling + "</lightsampling>")),
                                               2));
      INFO(lamp.name << ", " << sampling << ": " << drawn << ", by chance " << by_chance);
      CHECK(by_chance > 0.01);
      CHECK(std::abs(drawn / by_chance - 1) < bound);
    }
  }
}

TEST_CASE("a lamp in the middle of a sphere gives its closed form") {
  // The wall gets pi L (r/R)^2, and what it sends on but for the share that the lamp catches.
  const double radius = 0.25, albedo = 0.5, form = 1 - radius * radius;
  const double wanted = albedo * 4 * radius * radius / (1 - albedo * form);
  const std::string scene =
      "<raytracer><viewplane><hres>6</hres><vres>6</vres><samples>256</samples></viewplane><camera>"
      "<eye x='0' y='0' z='0.6'/><lookat x='0' y='0' z='2'/><fov>60</fov></camera><integrator><path>"
      "<maxdepth>32</maxdepth></path></integrator><materials><mattes><matte><name>m</name><ka>0</ka><kd>0.5</kd>"
      "<cd red='1' green='1' blue='1'/></matte></mattes><emissives><emissive><name>lamp</name>"
      "<ce red='4' green='4' blue='4'/></emissive></emissives></materials><objects><spheres><sphere>"
      "<center x='0' y='0' z='0'/><radius>1</radius><material>m</material></sphere><sphere>"
      "<center x='0' y='0' z='0'/><radius>0.25</radius><material>lamp</material></sphere></spheres></objects>"
      "</raytracer>";
  for (const std::string& isa : usable_isas()) {
    const double drawn = mean_green(rendered(parsed_scene(scene), 2, isa));
    INFO(isa << " " << drawn << " for " << wanted);
    CHECK(std::abs(drawn / wanted - 1) < 0.005);
  }
}

TEST_CASE("a floor far below a small lamp is lit as by a point") {
  // A disk of area A and radiance L, straight above: E = L A / d^2.
  const double distance = 200, radius = 0.5;
  std::string scene = room(
      "<disks><disk><center x='0' y='199' z='0'/><normal x='0' y='-1' z='0'/><radius>0.5</radius>M"
      "</disk></disks>",
      "", 16, "");
  const std::string camera = "<eye x='0' y='1' z='4'/><lookat x='0' y='-0.4' z='0'/><fov>50</fov>";
  scene.replace(scene.find(camera), camera.size(),
                "<eye x='0' y='0' z='0.1'/><lookat x='0' y='-1' z='0'/><fov>2</fov>");
  scene.replace(scene.find("<maxdepth>2"), 11, "<maxdepth>1");
  const double wanted = 0.6 / pi * 2 * pi * radius * radius / (distance * distance);
  CHECK(std::abs(mean_green(rendered(parsed_scene(scene))) / wanted - 1) < 1e-3);
}

TEST_CASE("a floor below an elliptical lamp gets its closed form in few samples") {
  // On the axis of an ellipse at the distance d, pi L a b / sqrt((a^2 + d^2) (b^2 + d^2)); less that of its hole.
  const auto form = [](double a, double b) { return a * b / std::sqrt((a * a + 1) * (b * b + 1)); };
  const auto lit_by = [](const std::string& lamp) {
    std::string scene = room(lamp, "", 16, "");
    const std::string camera = "<eye x='0' y='1' z='4'/><lookat x='0' y='-0.4' z='0'/><fov>50</fov>";
    scene.replace(scene.find(camera), camera.size(),
                  "<eye x='0' y='-0.5' z='0.1'/><lookat x='0' y='-1' z='0'/><fov>0.1</fov>");
    scene.replace(scene.find("<plane><point x='0' y='0' z='-1.5'"), 34, "<plane><point x='0' y='0' z='-900'");
    scene.replace(scene.find("<maxdepth>2"), 11, "<maxdepth>1");
    return mean_green(rendered(parsed_scene(scene))) / (0.6 * 2);
  };
  const std::string stretched = "M<transform><scale x='1.5' y='1' z='0.2'/></transform>";
  const double disk =
      lit_by("<disks><disk><center x='0' y='0' z='0'/><normal x='0' y='-1' z='0'/><radius>0.4</radius>" + stretched +
             "</disk></disks>");
  const double annulus = lit_by(
      "<annuli><annulus><center x='0' y='0' z='0'/><normal x='0' y='-1' z='0'/><innerradius>0.2</innerradius>"
      "<outerradius>0.4</outerradius>" +
      stretched + "</annulus></annuli>");
  INFO(disk << ", " << annulus);
  CHECK(std::abs(disk / form(0.6, 0.08) - 1) < 0.003);
  CHECK(std::abs(annulus / (form(0.6, 0.08) - form(0.3, 0.04)) - 1) < 0.003);
}

TEST_CASE("a lamp cut into many triangles is as bright as one") {
  std::string triangles = "<meshes><mesh><positions>";
  constexpr int cuts = 30;
  for (int y = 0; y <= cuts; ++y)
    for (int x = 0; x <= cuts; ++x)
      triangles += std::to_string(-0.5 + double(x) / cuts) + " 0.3 " + std::to_string(-0.5 + double(y) / cuts) + "  ";
  triangles += "</positions><faces>";
  const auto vertex = [](int x, int y) { return std::to_string(y * (cuts + 1) + x) + " "; };
  for (int y = 0; y < cuts; ++y)
    for (int x = 0; x < cuts; ++x)
      triangles += vertex(x, y) + vertex(x + 1, y) + vertex(x, y + 1) + "\n" + vertex(x + 1, y) + vertex(x + 1, y + 1) +
                   vertex(x, y + 1) + "\n";
  triangles += "</faces>M</mesh></meshes>";
  const double one = mean_green(
      rendered(parsed_scene(room("<rectangles><rectangle><corner x='-0.5' y='0.3' z='-0.5'/><edge1 x='1' y='0' z='0'/>"
                                 "<edge2 x='0' y='0' z='1'/>M</rectangle></rectangles>",
                                 "", 256, "")),
               2));
  for (const std::string sampling : {"tree", "power", "uniform"}) {
    const double many = mean_green(
        rendered(parsed_scene(room(triangles, "", 256, "<lightsampling>" + sampling + "</lightsampling>")), 2));
    INFO(sampling << ": " << many << ", one: " << one);
    CHECK(std::abs(many / one - 1) < 0.01);
  }
}

TEST_CASE("a lamp with a texture is as bright where it is drawn as where it is met") {
  // Half of it, in squares, so that all of these are cut into pieces.
  const auto bright = [](const std::string& lamp, const std::string& more, int samples) {
    std::string text = room(lamp, more, samples, "");
    const std::string root = "<raytracer>", color = "<ce red='1' green='1' blue='1'/>";
    text.insert(root.size(),
                "<textures><checkers><checker><name>squares</name><color1 red='1' green='1' blue='1'/>"
                "<color2 red='0' green='0' blue='0'/><uvscale x='3' y='2'/></checker></checkers></textures>");
    text.replace(text.find(color), color.size(), "<ce red='1' green='1' blue='1' texture='squares'/>");
    text.replace(text.find("<fov>50"), 7, "<fov>6");  // small pixels, which see the squares
    return mean_green(rendered(parsed_scene(text), 2));
  };
  const std::string mirrored =
      "<transform><scale x='-1' y='1' z='0.5'/><rotate x='0' y='0' z='1' angle='20'/></transform>";
  const std::string quads =
      "<meshes><mesh><positions>-0.5 0.2 -0.5  0.5 0.2 -0.5  0.5 0.3 0.5  -0.5 0 0.4</positions>"
      "<faces>0 1 2 3</faces><uvs>0 0  1 0  1 1  0 1</uvs>M";
  const Lamp textured[] = {
      {"rectangle",
       "<rectangles><rectangle><corner x='-0.5' y='0.3' z='-0.5'/><edge1 x='1' y='0' z='0'/><edge2 x='0' y='0' z='1'/>"
       "M</rectangle></rectangles>"},
      {"triangle", lamps[1].objects},
      {"disk", lamps[4].objects},
      {"mirrored box", lamps[10].objects},
      {"annulus, skewed and mirrored", lamps[14].objects}};
  const auto check = [&](const std::string& name, const std::string& objects) {
    const std::string sides = name == "triangle" ? "<twosided>true</twosided>" : "";
    const double drawn = bright(objects, sides, 512),
                 met = bright(objects, sides + "<opacity>0.9999999</opacity>", is_sanitized ? 512 : 8192);
    INFO(name << ": " << drawn << ", by chance " << met);
    CHECK(met > 0.005);
    CHECK(std::abs(drawn / met - 1) < (is_sanitized ? 0.2 : 0.02));
  };
  for (const Lamp& lamp : textured) check(lamp.name, lamp.objects);
  check("quads", quads + "</mesh></meshes>");
  check("mirrored quads", quads + mirrored + "</mesh></meshes>");
}

TEST_CASE("of a lamp whose texture is dark but for a spot, light is drawn from the spot") {
  std::string text = room(
      "<rectangles><rectangle><corner x='-0.5' y='0.3' z='-0.5'/><edge1 x='1' y='0' z='0'/><edge2 x='0' y='0' z='1'/>"
      "M</rectangle></rectangles>",
      "", 64, "");
  const std::string root = "<raytracer>", color = "<ce red='1' green='1' blue='1'/>";
  text.insert(root.size(), "<textures><images><image><name>spot</name><file>made</file></image></images></textures>");
  text.replace(text.find(color), color.size(), "<ce red='1' green='1' blue='1' texture='spot'/>");
  text.replace(text.find("<fov>50"), 7, "<fov>2");  // small pixels, which see the spot as it is
  const auto with_spot = [&](const std::string& scene_text) {
    SceneDescription scene = parsed_scene(scene_text);
    Picture picture{{32, 32, 4, TexelFormat::bytes}, LargeArray<std::byte>::zeros(std::size_t{32} * 32 * 4)};
    for (std::size_t i = 0; i < 4; ++i) picture.pixels[(7 * 32 + 21) * 4 + i] = std::byte{255};
    const auto texels = std::make_shared<const TexelImage>(picture, true, 1);
    std::get<TextureItems<Image>>(scene.textures).at(0).image = {"made", texels, texels};
    return rendered(scene, 2);
  };
  const FloatPicture some = with_spot(text);
  std::string evenly = text;
  evenly.replace(evenly.find("</maxdepth>"), 11, "</maxdepth><lightsampling>uniform</lightsampling>");
  const FloatPicture even = with_spot(evenly);
  text.replace(text.find("<samples>64<"), 12, "<samples>2048<");
  const FloatPicture many = with_spot(text);
  const auto error = [&](const FloatPicture& picture) {
    double apart = 0;
    for (std::size_t i = 0; i < picture.pixels().size(); ++i)
      apart += std::abs(double{picture.pixels()[i].green} - double{many.pixels()[i].green});
    return apart / static_cast<double>(picture.pixels().size()) / mean_green(many);
  };
  INFO(error(some) << ", drawn evenly " << error(even) << "; " << mean_green(many) << ", " << mean_green(even));
  CHECK(error(some) < error(even) * 0.3);
}

TEST_CASE("round shapes that shine are drawn, and not left to chance, where they are stretched") {
  const std::string stretched = "</radius>M<transform><scale x='1' y='4' z='2'/></transform>";
  const std::string lamp =
      GENERATE_COPY("<spheres><sphere><center x='0' y='0' z='0'/><radius>0.05" + stretched + "</sphere></spheres>",
                    "<disks><disk><center x='0' y='0' z='0'/><normal x='1' y='-1' z='1'/><radius>0.05" + stretched +
                        "</disk></disks>");
  const auto with = [&](const std::string& emissive, int samples) {
    return rendered(parsed_scene(room(lamp, emissive, samples, "")), 2);
  };
  const FloatPicture many = with("", 1024);
  const auto error = [&](const FloatPicture& picture) {
    double apart = 0;
    for (std::size_t i = 0; i < picture.pixels().size(); ++i)
      apart += std::abs(double{picture.pixels()[i].green} - double{many.pixels()[i].green});
    return apart / static_cast<double>(picture.pixels().size()) / mean_green(many);
  };
  const double drawn = error(with("", 64)), met = error(with("<opacity>0.9999999</opacity>", 64));
  INFO(drawn << ", by chance " << met);
  CHECK(drawn < met * 0.5);
}

TEST_CASE("lamps in instances are drawn as lamps that stand there themselves") {
  const std::string lamp =
      "<spheres><sphere><center x='0.1' y='0' z='0'/><radius>0.2</radius>M T</sphere></spheres><boxes><box>"
      "<min x='-0.5' y='-0.1' z='-0.1'/><max x='-0.3' y='0.1' z='0.2'/>M T</box></boxes>";
  const std::string transform =
      "<transform><rotate x='1' y='1' z='0' angle='40'/><scale x='1.2' y='1.2' z='1.2'/></transform>";
  const auto with = [&](const std::string& instead) {
    std::string objects = lamp;
    for (std::size_t at = 0; (at = objects.find('T', at)) != std::string::npos; at += instead.size())
      objects.replace(at, 1, instead);
    return objects;
  };
  const double single = mean_green(rendered(parsed_scene(room(with(transform), "", 512, "")), 2));
  std::string text = room("", "", 512, "");
  std::string group = "<groups><group><name>g</name><objects>" + with("") + "</objects></group></groups>";
  for (std::size_t at = 0; (at = group.find('M', at)) != std::string::npos;)
    group.replace(at, 1, "<material>lamp</material>");
  text.insert(text.find("<objects>"), group);
  text.insert(text.rfind("</objects>"),
              "<instances><instance><group>g</group>" + transform + "</instance></instances>");
  const double instanced = mean_green(rendered(parsed_scene(text), 2));
  INFO(instanced << ", single " << single);
  CHECK(single > 0.01);
  CHECK(std::abs(instanced / single - 1) < 0.02);
}

TEST_CASE("a lamp of a group that has a transform of its own is drawn there alone, not where it would be without") {
  const std::string ball = "<spheres><sphere><center x='0.6' y='0' z='0'/><radius>0.1</radius>G</sphere></spheres>";
  const std::string lamp =
      "<boxes><box><min x='-0.1' y='-0.1' z='-0.1'/><max x='0.1' y='0.1' z='0.1'/>M<transform>"
      "<scale x='1' y='1' z='3'/><rotate x='1' y='1' z='0' angle='35'/><translate x='-0.4' y='0.1' z='0'/></transform>"
      "</box></boxes>";
  const auto brightness = [&](const std::string& all_objects, const std::string& grouped) {
    const auto with_materials = [](std::string objects) {
      for (const auto& [letter, name] : {std::pair('M', "lamp"), std::pair('G', "grey")})
        for (std::size_t at = 0; (at = objects.find(letter, at)) != std::string::npos;)
          objects.replace(at, 1, "<material>" + std::string(name) + "</material>");
      return objects;
    };
    std::string text = room("", "", 256, "");
    if (!grouped.empty())
      text.insert(text.find("<objects>"),
                  "<groups><group><name>g</name><objects>" + with_materials(grouped) + "</objects></group></groups>");
    text.insert(text.rfind("</objects>"), with_materials(all_objects));
    return mean_green(rendered(parsed_scene(text), 2));
  };
  const double grouped = brightness("<instances><instance><group>g</group></instance></instances>", ball + lamp);
  const double single = brightness(ball + lamp, "");
  INFO(grouped << ", without a group " << single);
  CHECK(std::abs(grouped / single - 1) < 0.02);
}

TEST_CASE("lamps in instances are as bright far from the origin as at it") {
  // Since the camera looks at a point far behind them, the scene's origin stays where it is.
  const auto mean_at = [](double x) {
    const std::string at = "<translate x='" + std::to_string(x) + "' y='0' z='0'/>", from = std::to_string(x);
    return mean_green(rendered(parsed_scene(
        "<raytracer><viewplane><hres>16</hres><vres>16</vres><samples>64</samples></viewplane><camera><eye x='" + from +
        "' y='0.25' z='0.6'/><lookat x='" + from +
        "' y='-28.75' z='-59.4'/><fov>45</fov></camera><integrator><path><maxdepth>1</maxdepth></path></integrator>"
        "<materials><mattes><matte><name>floor</name><ka>0</ka><kd>1</kd><cd red='0.7' green='0.7' blue='0.7'/></matte>"
        "</mattes><emissives><emissive><name>lamp</name><ce red='4' green='4' blue='4'/></emissive></emissives>"
        "</materials><groups><group><name>g</name><objects><rectangles><rectangle><corner x='-0.1' y='0.3' z='-0.1'/>"
        "<edge1 x='0.2' y='0' z='0'/><edge2 x='0' y='0' z='0.2'/><material>lamp</material></rectangle></rectangles>"
        "</objects></group></groups><objects><rectangles><rectangle><corner x='-0.3' y='-0.1' z='0.3'/>"
        "<edge1 x='0.6' y='0' z='0'/><edge2 x='0' y='0' z='-0.6'/><material>floor</material><transform>" +
        at + "</transform></rectangle></rectangles><instances><instance><group>g</group><transform>" + at +
        "</transform></instance></instances></objects></raytracer>")));
  };
  const double near = mean_at(0), far = mean_at(4000);
  INFO(far << ", at the origin " << near);
  CHECK(std::abs(far / near - 1) < 1e-3);
}

TEST_CASE("a floor close below a huge sphere that shines gets all the light of its hemisphere") {
  const double lit = mean_green(rendered(parsed_scene(
      "<raytracer><viewplane><hres>8</hres><vres>8</vres><samples>64</samples></viewplane><camera>"
      "<eye x='0.5' y='0.4' z='0'/><lookat x='0' y='0' z='0'/><fov>0.2</fov></camera><integrator><path>"
      "<maxdepth>1</maxdepth></path></integrator><materials><mattes><matte><name>floor</name><ka>0</ka><kd>0.8</kd>"
      "<cd red='1' green='1' blue='1'/></matte></mattes><emissives><emissive><name>lamp</name>"
      "<ce red='1' green='1' blue='1'/></emissive></emissives></materials><objects><spheres><sphere>"
      "<center x='0' y='100001' z='0'/><radius>100000</radius><material>lamp</material></sphere></spheres>"
      "<rectangles><rectangle><corner x='-0.5' y='0' z='0.5'/><edge1 x='1' y='0' z='0'/><edge2 x='0' y='0' z='-1'/>"
      "<material>floor</material></rectangle></rectangles></objects></raytracer>")));
  INFO(lit);
  CHECK(std::abs(lit / 0.8 - 1) < 0.003);
}

TEST_CASE("the inside of a sphere that shines is lit by itself") {
  const double lit = mean_green(rendered(parsed_scene(
      "<raytracer><viewplane><hres>8</hres><vres>8</vres><samples>256</samples></viewplane><camera>"
      "<eye x='0.5' y='0.4' z='0'/><lookat x='0' y='0' z='0'/><fov>90</fov></camera><integrator><path>"
      "<maxdepth>40</maxdepth></path></integrator><materials><openpbrs><openpbr><name>lamp</name>"
      "<base_color red='0.5' green='0.5' blue='0.5'/><specular_weight>0</specular_weight>"
      "<emission_luminance>1</emission_luminance><geometry_thin_walled>true</geometry_thin_walled></openpbr></openpbrs>"
      "</materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>3</radius><material>lamp</material>"
      "</sphere></spheres></objects></raytracer>")));
  INFO(lit);
  CHECK(std::abs(lit / 2 - 1) < 0.01);
}

TEST_CASE("drawn light does not depend on threads, samples at once, or how the picture is cut") {
  std::string all;
  for (const Lamp& lamp : lamps) all += lamp.objects;
  const SceneDescription description = parsed_scene(room(all, GENERATE("", "<twosided>true</twosided>"), 16, ""));
  check_same_bits(description);
}

}  // namespace raytrace::test
