// What becomes of the light that fog scatters: in transparent pictures, behind panes and many fogs in a row, and where
// light that was scattered often is clamped.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "raytrace/aovs/aov_selection.h"
#include "render/fogged.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

TEST_CASE("fog has the same colour in a transparent picture as before a black background") {
  // Thin enough to cover little, of all that there is to see; in one half of the picture, before a wall, too.
  Fogged scene;
  scene.free_path = "20";
  scene.eye = "<eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/><fov>10</fov>";
  scene.lights =
      "<pointlights><pointlight><location x='0' y='2' z='0'/><falloff>inversesquare</falloff><group>a</group>"
      "</pointlight></pointlights><environmentlights><environmentlight><color red='1' green='0.5' blue='0.2'/>"
      "<visible>false</visible><group>b</group></environmentlight></environmentlights>";
  scene.objects =
      "<rectangles><rectangle><corner x='0' y='-9' z='-4'/><edge1 x='9' y='0' z='0'/>"
      "<edge2 x='0' y='18' z='0'/><material>grey</material></rectangle></rectangles>";
  scene.samples = 16;
  const SceneDescription description = parsed_scene(text_of(scene));
  const auto built = build_scene(description, {2, {}});
  const auto picture = [&](bool transparent, bool by_groups) {
    RenderSettings settings{2, 0, whole(description)};
    settings.transparent = transparent;
    if (by_groups) settings.aovs = aov_set({"light_a", "light_b", "light_default"});
    RayCounts rays;
    return render(*built, description, settings, rays).pixels();
  };
  const std::vector<Pixel> opaque = picture(false, false);
  for (const bool by_groups : {false, true}) {
    const std::vector<Pixel> transparent = picture(true, by_groups);
    double covered = 0, largest_difference = 0;
    for (std::size_t i = 0; i < opaque.size(); ++i) {
      covered += double{transparent[i].alpha} / static_cast<double>(opaque.size());
      for (const auto channel : {&Pixel::red, &Pixel::green, &Pixel::blue}) {
        const double expected = opaque[i].*channel, difference = std::abs(double{transparent[i].*channel} - expected);
        largest_difference = std::max(largest_difference, difference / expected);
      }
    }
    INFO("covered " << covered << ", difference " << largest_difference << (by_groups ? ", by groups" : ""));
    CHECK((covered > 0.5 && covered < 0.7));
    CHECK(largest_difference < 1e-5);
  }
}

TEST_CASE("light paths and photons that come through a pane are in the fog that begins there") {
  const std::string caustics = GENERATE("light", "photons");
  const std::string pane = GENERATE(
      "<rectangles><rectangle><corner x='-3' y='-3' z='1'/><edge1 x='6' y='0' z='0'/><edge2 x='0' y='6' z='0'/>"
      "<material>pane</material></rectangle></rectangles>",
      "<boxes><box><min x='-3' y='-3' z='1'/><max x='3' y='3' z='1.3'/><material>pane</material></box></boxes>");
  const auto mean = [&](const std::string& end) {
    Fogged scene;
    scene.path = "<maxdepth>8</maxdepth><caustics>" + caustics + "</caustics>";
    scene.materials = "<dielectrics><dielectric><name>pane</name><thinwalled>" +
                      std::string(pane.starts_with("<boxes>") ? "false" : "true") +
                      "</thinwalled></dielectric></dielectrics>";
    scene.objects = pane +
                    "<rectangles><rectangle><corner x='-3' y='-3' z='-3'/><edge1 x='6' y='0' z='0'/>"
                    "<edge2 x='0' y='6' z='0'/><material>grey</material></rectangle></rectangles>"
                    "<spheres><sphere><center x='0.5' y='0' z='4'/><radius>1.2</radius><material>lamp</material>"
                    "</sphere></spheres>";
    scene.box = "<box><min x='-3' y='-3' z='-3'/><max x='3' y='3' z='" + end + "'/><material>fog</material></box>";
    scene.free_path = "3";
    scene.eye = "<eye x='3.2' y='0.5' z='0.5'/><lookat x='0' y='0' z='-2.5'/><fov>50</fov>";
    return mean_of(scene).red;
  };
  const double there = mean("1"), before = mean("0.999");
  INFO(caustics << ", " << pane << ": " << there << " for " << before);
  CHECK(std::abs(there / before - 1) < 0.02);
}

TEST_CASE("lights shine into fog through a pane as through none") {
  const std::string caustics = GENERATE("none", "photons");
  const auto [kind, lights, lamp] = GENERATE(table<std::string, std::string, std::string>(
      {{"sun",
        "<directionallights><directionallight><direction x='1' y='0' z='0'/></directionallight></directionallights>",
        ""},
       {"sky", "<environmentlights><environmentlight/></environmentlights>", ""},
       {"lamp", "",
        "<spheres><sphere><center x='40' y='0' z='0'/><radius>20</radius><material>lamp</material></sphere>"
        "</spheres>"}}));
  const auto mean = [&, its_lights = lights, its_lamp = lamp](const std::string& pane, int depth) {
    Fogged scene;
    scene.fog = "<color red='1' green='1' blue='1'/>";
    scene.box = "<box><min x='-1' y='-1' z='-3'/><max x='1' y='1' z='2'/><material>fog</material></box>";
    scene.materials =
        "<dielectrics><dielectric><name>pane</name><ior>1</ior><thinwalled>true</thinwalled></dielectric>"
        "</dielectrics>";
    scene.lights = its_lights;
    scene.objects = its_lamp + pane;
    scene.path = "<maxdepth>" + std::to_string(depth) + "</maxdepth><caustics>" + caustics + "</caustics>";
    scene.samples = 128;
    return mean_of(scene).red;
  };
  // Where the fog ends. Of the sky, some comes beside it.
  const std::string pane =
      "<rectangles><rectangle><corner x='1' y='-9' z='-9'/><edge1 x='0' y='18' z='0'/><edge2 x='0' y='0' z='18'/>"
      "<material>pane</material></rectangle></rectangles>";
  // What is scattered once, and comes through the pane.
  const double open = mean("", 1), through = mean(pane, 2), twice = mean("", 2);
  INFO(caustics << ", " << kind << ": " << through << " for " << open << " to " << twice);
  if (kind == "sun") {
    CHECK(through > 0.999 * open);
    CHECK(through < 1.001 * twice);
    CHECK(std::abs(mean(pane, 12) / mean("", 10) - 1) < 0.01);
  } else {
    CHECK(std::abs(mean(pane, 12) / mean("", 10) - 1) < 0.015);
  }
}

TEST_CASE("fog between faces of glass that lead nowhere, and instances, has a picture") {
  // Paths end in glass that they have never come out of. Their hits are nothing, and still have to be of something.
  std::mt19937 bits(GENERATE(3U, 6U, 9U));
  const auto place = [&](const std::string& element) {
    const auto coordinate = [&] { return std::to_string(static_cast<int>(bits() % 120) / 10.0 - 6); };
    const std::string x = coordinate();
    return '<' + element + " x='" + x + "' y='0.3' z='" + coordinate() + "'/>";
  };
  std::string glass, cones;
  for (int i = 0; i < 60; ++i) {
    glass += "<rectangle>" + place("corner") + "<edge1 x='2' y='0' z='0.7'/><edge2 x='0' y='2' z='0'/><material>" +
             (i % 2 == 0 ? "glass" : "water") + "</material></rectangle>";
    cones += "<instance><group>tree</group><transform>" + place("translate") + "</transform></instance>";
  }
  Fogged scene;
  scene.free_path = "12";
  scene.eye = "<eye x='0' y='2' z='8'/><lookat x='0' y='1.5' z='0'/><fov>50</fov>";
  scene.samples = 4;
  scene.path = "";
  scene.materials =
      "<dielectrics><dielectric><name>glass</name><priority>2</priority></dielectric><dielectric><name>water</name>"
      "<ior>1.33</ior></dielectric></dielectrics>";
  scene.lights =
      "<directionallights><directionallight><direction x='1' y='1' z='0.3'/></directionallight></directionallights>";
  scene.box = "<box><min x='-30' y='-0.1' z='-30'/><max x='30' y='8' z='30'/><material>fog</material></box>";
  scene.objects = "<rectangles>" + glass + "</rectangles><instances>" + cones + "</instances>";
  std::string text = text_of(scene);
  text.replace(text.find("<hres>16</hres><vres>16</vres>"), 30, "<hres>96</hres><vres>64</vres>");
  text.insert(
      text.find("<objects>"),
      "<groups><group><name>tree</name><objects><cones><cone><bottom x='0' y='0' z='0'/><top x='0' y='4' z='0'/>"
      "<radius>0.6</radius><material>grey</material></cone></cones></objects></group></groups>");
  const SceneDescription description = parsed_scene(text);
  for (const std::string& isa : usable_isas()) CHECK(std::isfinite(mean_of(rendered(description, 1, isa)).red));
}

TEST_CASE("many fogs in a row let through what one of their depth does") {
  // 80 sheets, and gaps between them: their free flights have nothing to do with each other.
  Fogged scene;
  scene.free_path = "5";
  scene.fog = "<color red='0' green='0' blue='0'/>";
  scene.background = "<background red='1' green='1' blue='1'/>";
  scene.box = "";
  constexpr int sheets = 80;
  constexpr double thickness = 0.1;
  for (int i = 0; i < sheets; ++i) {
    const double z = -0.2 * i;
    scene.box += "<box><min x='-9' y='-9' z='" + std::to_string(z - thickness) + "'/><max x='9' y='9' z='" +
                 std::to_string(z) + "'/><material>fog</material></box>";
  }
  const double expected = std::exp(-sheets * thickness / 5);
  const double mean = mean_of(scene).red;
  INFO(mean << " of " << expected);
  CHECK(std::abs(mean - expected) < 0.01);
}

TEST_CASE("fogs that end in one plane end there for rays that leave by it, be they of one material or of several") {
  // Black ones, that overlap; the ray leaves obliquely by the plane y = 2, where all of them end.
  const auto picture = [](const std::vector<std::string>& materials) {
    const std::string boxes[] = {"<min x='-2' y='-2' z='-1.4'/><max x='2' y='2' z='1.4'/>",
                                 "<min x='-1' y='-2' z='-3'/><max x='3' y='2' z='1'/>",
                                 "<min x='-1' y='-2' z='-2'/><max x='3' y='2' z='1.2'/>"};
    Fogged scene;
    scene.fog =
        "<color red='0' green='0' blue='0'/></fog><fog><name>other</name><meanfreepath>2</meanfreepath><color red='0' "
        "green='0' blue='0'/></fog><fog><name>third</name><meanfreepath>2</meanfreepath><color red='0' green='0' "
        "blue='0'/>";
    scene.background = "<background red='1' green='1' blue='1'/>";
    scene.eye = "<eye x='0.5' y='0' z='10'/><lookat x='0.5' y='2' z='0'/><fov>0.01</fov>";
    scene.box.clear();
    for (std::size_t i = 0; i < materials.size(); ++i)
      scene.box += "<box>" + boxes[i] + "<material>" + materials[i] + "</material></box>";
    return scene;
  };
  const double expected = std::exp(-1.4 * std::hypot(1.0, 0.2) / mean_free_path);
  for (const std::string& isa : usable_isas())
    for (const std::vector<std::string>& materials :
         {std::vector<std::string>{"fog"}, {"fog", "fog"}, {"fog", "other"}, {"fog", "other", "third"}}) {
      INFO(isa << ", " << materials.size() << " of them, the last is " << materials.back());
      CHECK(std::abs(mean_of(picture(materials), isa).red - expected) < 0.006);
    }
}

TEST_CASE("clampindirect clamps what fog has scattered twice, however it comes to the light") {
  Fogged scene;
  scene.fog = "<color red='0.9' green='0.9' blue='0.9'/>";
  scene.lights =
      "<environmentlights><environmentlight><color red='1' green='1' blue='1'/></environmentlight>"
      "</environmentlights>";
  scene.samples = 1024;
  const double once = mean_of(scene).red;
  scene.path = "<maxdepth>8</maxdepth>";
  const double often = mean_of(scene).red;
  scene.path += "<clampindirect>0.000001</clampindirect>";
  const double clamped = mean_of(scene).red;
  INFO(once << ", " << often << ", clamped " << clamped);
  CHECK(often > 1.3 * once);
  CHECK(std::abs(clamped / once - 1) < 0.01);
}

TEST_CASE("fog that is the same everywhere and shines sends what it would absorb, without noise") {
  Fogged scene;
  scene.samples = 8;
  const std::string black = "<color red='0' green='0' blue='0'/><ce red='2' green='1' blue='0.5'/>";
  for (const double density : {1.0, 0.5, 0.0001}) {
    scene.fog = black + "<density>" + std::to_string(density) + "</density>";
    const double wanted = 1 - std::exp(-5 * density / mean_free_path);
    for (const std::string& isa : usable_isas()) {
      const Mean mean = mean_of(scene, isa);
      INFO(isa << ", " << density << ": " << mean.red << " for " << 2 * wanted);
      CHECK(std::abs(mean.red / (2 * wanted) - 1) < 1e-4);
      CHECK(std::abs(mean.green / wanted - 1) < 1e-4);
      CHECK(std::abs(mean.blue / (0.5 * wanted) - 1) < 1e-4);
    }
  }
  // Of what scatters light, the first ray has as much, and paths find more.
  scene.fog = "<ce red='2' green='1' blue='0.5'/>";
  scene.path = "<maxdepth>8</maxdepth>";
  CHECK(mean_of(scene).red > 2 * (1 - std::exp(-5 / mean_free_path)));
}

}  // namespace raytrace::test
