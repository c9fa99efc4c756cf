// What light groups bring to a picture: they add up to it exactly, and each is what its lights bring alone.
#include "raytrace/description/light_groups.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/film/splat_layer.h"
#include "raytrace/parameters/light_group.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// Lights of all types in groups a, b and the default one. only: the group whose lights the scene has alone; empty:
/// all.
std::string lit_scene(const std::string& integrator, const std::string& only = "", const std::string& viewplane = "") {
  const auto of = [&](const std::string& group, const std::string& begin, const std::string& end) {
    const std::string name = group.empty() ? "" : "<group>" + group + "</group>";
    return only.empty() || only == (group.empty() ? "default" : group) ? begin + name + end : std::string();
  };
  const std::string lights =
      of("b", "<ambientlight><scaleradiance>0.1</scaleradiance>", "</ambientlight>") + "<pointlights>" +
      of("a", "<pointlight><location x='3' y='5' z='3'/><scaleradiance>2</scaleradiance>", "</pointlight>") +
      of("", "<pointlight><location x='-4' y='4' z='2'/><color red='0.3' green='0.5' blue='1'/>", "</pointlight>") +
      of("a", "<pointlight><location x='0' y='6' z='-1'/><color red='1' green='0.5' blue='0.2'/>", "</pointlight>") +
      "</pointlights><spotlights>" +
      of("b", "<spotlight><location x='0' y='5' z='5'/><lookat x='0' y='0' z='0'/><coneangle>30</coneangle>",
         "</spotlight>") +
      "</spotlights>";
  const bool keeps_background = only.empty() || only == "default";
  return "<raytracer>" + integrator + "<viewplane><hres>20</hres><vres>14</vres><samples>8</samples>" + viewplane +
         (keeps_background ? "<background red='0.1' green='0.2' blue='0.3'/>" : "") +
         "</viewplane><camera><eye x='0' y='3' z='7'/><lookat x='0' y='0.5' z='0'/><fov>40</fov></camera><lights>" +
         lights + "</lights><materials><mattes><matte><name>floor</name><ka>0.5</ka><kd>0.7</kd>" +
         "<cd red='0.9' green='0.8' blue='0.7'/></matte></mattes><phongs><phong><name>plastic</name><ka>0.3</ka>" +
         "<kd>0.5</kd><ks>0.3</ks><exp>20</exp><cd red='0.2' green='0.4' blue='0.8'/><cs red='1' green='1' blue='1'/>" +
         "</phong></phongs></materials><objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/>" +
         "<material>floor</material></plane></planes><spheres><sphere><center x='-1' y='1' z='0'/><radius>1</radius>" +
         "<material>plastic</material></sphere><sphere><center x='1.3' y='0.8' z='0.4'/><radius>0.8</radius>" +
         "<material>floor</material></sphere></spheres></objects></raytracer>";
}

/// What shines, with and without an environment, mirrors and glass, which light paths come by.
std::string shining_scene(const std::string& path, const std::string& camera, const std::string& viewplane = "") {
  return "<raytracer><integrator><path>" + path +
         "</path></integrator><viewplane><hres>16</hres><vres>12</vres><samples>8</samples>" + viewplane +
         "</viewplane>" + camera + "<lights><environmentlights><environmentlight><scaleradiance>0.3</scaleradiance>" +
         "<group>sky</group></environmentlight></environmentlights><directionallights><directionallight><direction " +
         "x='1' y='2' z='1'/><angle>2</angle><group>sun</group></directionallight></directionallights></lights>" +
         "<materials><mattes><matte><name>floor</name><ka>0</ka><kd>0.7</kd><cd red='0.9' green='0.8' blue='0.7'/>" +
         "</matte></mattes><dielectrics><dielectric><name>glass</name></dielectric></"
         "dielectrics><emissives><emissive>" +
         "<name>lamp</name><ce red='1' green='0.5' blue='0.2'/><scaleradiance>20</scaleradiance><group>lamp</group>" +
         "</emissive><emissive><name>panel</name><ce texture='stripes'/><scaleradiance>9</scaleradiance></emissive>" +
         "</emissives><openpbrs><openpbr><name>coal</name><emission_luminance>2</emission_luminance><emission_color " +
         "red='1' green='0.1' blue='0'/><group>lamp</group></openpbr></openpbrs></materials><textures><checkers>" +
         "<checker><name>stripes</name><color1 red='1' green='1' blue='1'/><color2 red='0.1' green='0' blue='0'/>" +
         "<uvscale x='4' y='4'/></checker></checkers></textures><objects><rectangles><rectangle><corner x='-5' y='0' " +
         "z='5'/><edge1 x='10' y='0' z='0'/><edge2 x='0' y='0' z='-10'/><material>floor</material></rectangle>" +
         "<rectangle><corner x='-3' y='0' z='-2'/><edge1 x='2' y='0' z='0'/><edge2 x='0' y='2' z='0'/><material>panel" +
         "</material></rectangle></rectangles><spheres><sphere><center x='0' y='0.9' z='0'/><radius>0.8</radius>" +
         "<material>glass</material></sphere><sphere><center x='2' y='3' z='-1'/><radius>0.5</radius><material>lamp" +
         "</material></sphere><sphere><center x='1.6' y='0.4' z='1'/><radius>0.4</radius><material>coal</material>" +
         "</sphere></spheres></objects></raytracer>";
}

const std::string pinhole = "<camera><eye x='0' y='4' z='6'/><lookat x='0' y='0.5' z='0'/><fov>45</fov></camera>";

/// With layers of all light groups.
Film film_by_group(const SceneDescription& description, const std::string& isa = {}, bool transparent = false) {
  AovSet aovs;
  for (const std::string& name : light_group_names(description)) aovs.add_light_group(name);
  const auto scene = build_scene(description, {1, isa});
  RenderSettings settings{1, 0, whole(description)};
  settings.aovs = aovs;
  settings.transparent = transparent;
  RayCounts rays;
  return render(*scene, description, settings, rays);
}

RadianceSum own_sum(const Film& film, int x, int y) {
  const PixelSum& sum = film.sum(x, y);
  const PixelSumHigh high = film.high(x, y);
  return {from_limbs({sum.red, high.red}), from_limbs({sum.green, high.green}), from_limbs({sum.blue, high.blue})};
}

/// Fails where the groups' sums do not add up to the film's, or where a group has nothing at all.
void check_sums(const Film& film, bool some_are_dark = false) {
  int apart = 0;
  for_each_pixel(film.region(), [&](std::size_t, int x, int y) {
    RadianceSum own{}, splats{};
    for (const LightLayer& layer : film.lights())
      for (std::size_t channel = 0; channel < own.size(); ++channel) {
        own[channel] += layer.samples->sum(x, y)[channel];
        if (layer.splats) splats[channel] += layer.splats->sum(x, y)[channel];
      }
    apart += own != own_sum(film, x, y);
    if (film.splats() != nullptr) apart += splats != film.splats()->sum(x, y);
  });
  CHECK(apart == 0);
  for (const LightLayer& layer : film.lights()) {
    bool any = false;
    for_each_pixel(film.region(),
                   [&](std::size_t, int x, int y) { any = any || layer.samples->sum(x, y) != RadianceSum{}; });
    INFO(layer.name);
    CHECK((any || some_are_dark));
  }
}

}  // namespace

TEST_CASE("light groups add up to the picture exactly, with every integrator, and with each instruction set") {
  for (const std::string& isa : usable_isas()) {
    INFO(isa);
    check_sums(film_by_group(parsed_scene(lit_scene("")), isa));
    check_sums(film_by_group(parsed_scene(lit_scene("")), isa, true));
    check_sums(film_by_group(parsed_scene(lit_scene("<integrator><path/></integrator>")), isa));
    check_sums(film_by_group(parsed_scene(lit_scene("<integrator><normals/></integrator>")), isa), true);
    for (const std::string path :
         {"", "<caustics>light</caustics>", "<caustics>photons</caustics>", "<clampindirect>0.5</clampindirect>"})
      for (const std::string& camera :
           {pinhole, std::string("<thinlenscamera><eye x='0' y='4' z='6'/><lookat x='0' y='0.5' z='0'/><fov>45</fov>"
                                 "<lensradius>0.2</lensradius><focaldistance>7</focaldistance></thinlenscamera>")}) {
        INFO(path << camera);
        check_sums(film_by_group(parsed_scene(shining_scene(path, camera)), isa));
      }
  }
}

TEST_CASE("integrators that know no lights show the same where the environment has a group") {
  const auto picture = [](const std::string& integrator, const std::string& group) {
    return rendered(parsed_scene(
        "<raytracer><viewplane><hres>40</hres><vres>30</vres><samples>4</samples></viewplane><camera><eye x='0' y='0' "
        "z='8'/><lookat x='0' y='0' z='0'/><fov>30</fov></camera><integrator><" +
        integrator + "/></integrator><lights><environmentlights><environmentlight>" + group +
        "<color red='5' green='2' blue='1'/></environmentlight></environmentlights></lights><materials><mattes><matte>"
        "<name>m</name><ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte></mattes></materials><objects>"
        "<spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>m</material></sphere></spheres>"
        "</objects></raytracer>"));
  };
  for (const std::string integrator : {"ambientocclusion", "normals", "albedo", "uv"}) {
    const FloatPicture without = picture(integrator, ""), with = picture(integrator, "<group>sky</group>");
    double most = 0;
    for (std::size_t i = 0; i < without.pixels().size(); ++i)
      most = std::max(most, difference(without.pixels()[i], with.pixels()[i]));
    INFO(integrator);
    CHECK(most < 1e-5);
  }
}

TEST_CASE("a layer of light groups does not change the picture") {
  for (const std::string& text : {lit_scene(""), shining_scene("<caustics>light</caustics>", pinhole)}) {
    const SceneDescription description = parsed_scene(text);
    CHECK(identical(FloatPicture(film_by_group(description)), rendered(description)));
  }
}

TEST_CASE("where lights have no group, the default one is the picture") {
  const SceneDescription description = parsed_scene(busy_scene(24, 18, 4));
  const Film film = film_by_group(description);
  REQUIRE(film.lights().size() == 1);
  int apart = 0;
  for_each_pixel(film.region(), [&](std::size_t, int x, int y) {
    apart += film.lights()[0].samples->sum(x, y) != own_sum(film, x, y);
    const Pixel a = film.pixel(x, y), b = film.light_pixel(film.lights()[0], x, y);
    apart += a.red != b.red || a.green != b.green || a.blue != b.blue;
  });
  CHECK(apart == 0);
}

TEST_CASE("a light group is what its lights bring alone") {
  for (const std::string integrator : {"", "<integrator><path/></integrator>"}) {
    const Film film = film_by_group(parsed_scene(lit_scene(integrator)));
    REQUIRE(film.lights().size() == 3);
    for (const LightLayer& layer : film.lights()) {
      INFO(integrator << layer.name);
      const FloatPicture alone =
          rendered(parsed_scene(lit_scene(integrator, layer.name.substr(light_aov_prefix.size()))));
      float apart = 0;
      for_each_pixel(film.region(), [&](std::size_t i, int x, int y) {
        Pixel mean = film.light_pixel(layer, x, y);
        mean.alpha = alone.pixels()[i].alpha;
        apart = std::max(apart, static_cast<float>(difference(mean, alone.pixels()[i])));
      });
      CHECK(apart < 1e-5F);
    }
  }
}

TEST_CASE("light beyond 64 bits adds up, too") {
  // As bright as a float, beside what is dim.
  std::string text = lit_scene("");
  text.replace(text.find("<scaleradiance>2<"), 17, "<scaleradiance>9e16<");
  const Film film = film_by_group(parsed_scene(text));
  CHECK(film.has_high());
  check_sums(film);
}

TEST_CASE("light groups are found by their names, and all are those of the scene") {
  const SceneDescription description = parsed_scene(lit_scene(""));
  const std::vector<std::string> names = light_group_names(description);
  CHECK(names == std::vector<std::string>{"default", "a", "b"});
  CHECK(light_group_names(parsed_scene(busy_scene(8, 8, 1))) == std::vector<std::string>{"default"});

  AovSet all;
  all.wants_all_light_groups = true;
  CHECK(aov_names(with_light_groups(all, names)) == std::vector<std::string>{"light_a", "light_b", "light_default"});
  CHECK(with_light_groups(all, {"default"}) == AovSet());
  CHECK(with_light_groups(aov_set({"light_default"}), {"default"}) == aov_set({"light_default"}));
  CHECK_THROWS_WITH(with_light_groups(aov_set({"light_c"}), names),
                    "no light of the scene is in the group 'c'; there are light_default, light_a, light_b");
}

}  // namespace raytrace::test
