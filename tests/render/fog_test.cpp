// Fog: against closed forms and sums over distances in double precision, and against itself where one picture can be
// had in two ways.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "render/fogged.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

std::string wall(double z, const std::string& material) {
  return "<rectangles><rectangle><corner x='-60' y='-60' z='" + std::to_string(z) +
         "'/><edge1 x='120' y='0' z='0'/><edge2 x='0' y='120' z='0'/><material>" + material +
         "</material></rectangle></rectangles>";
}

double phase(double cosine, double g) {
  return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// The sum of f over the camera ray's way through the fog, z from 2 down to -3: of f(z, way that it is in fog).
template <class F>
double along_ray(const F& f) {
  constexpr int steps = 200000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double way = 5 * (i + 0.5) / steps;
    sum += f(2 - way) * std::exp(-way / mean_free_path) / mean_free_path * 5 / steps;
  }
  return sum;
}

}  // namespace

TEST_CASE("fog absorbs what it does not scatter, on all of the way through it") {
  Fogged scene;
  scene.fog = "<color red='0' green='0' blue='0'/>";
  scene.objects = wall(-4, "lamp");
  scene.samples = 1024;
  for (const std::string& isa : usable_isas())
    CHECK(std::abs(mean_of(scene, isa).green - 3 * std::exp(-5 / mean_free_path)) < 0.01);
  // Not where something clear is in its place.
  scene.materials = "<dielectrics><dielectric><name>air</name><ior>1</ior></dielectric></dielectrics>";
  scene.box += "<box><min x='-40' y='-40' z='-1'/><max x='40' y='40' z='1'/><material>air</material></box>";
  scene.path = "";
  CHECK(std::abs(mean_of(scene).green - 3 * std::exp(-3 / mean_free_path)) < 0.02);
  // Of fogs in one place, that counts which the ray came into last.
  Fogged two;
  two.fog = scene.fog;
  two.objects = scene.objects;
  two.samples = 1024;
  two.box += "<box><min x='-40' y='-40' z='-1'/><max x='40' y='40' z='1'/><material>thin</material></box>";
  std::string text = text_of(two);
  text.replace(text.find("<fogs>"), 6, "<fogs><fog><name>thin</name><meanfreepath>1e9</meanfreepath></fog>");
  CHECK(std::abs(mean_of(rendered(parsed_scene(text), 2)).green - 3 * std::exp(-3 / mean_free_path)) < 0.02);
}

TEST_CASE("light that fog scatters once is the sum over all distances") {
  const double g = GENERATE(0.0, 0.7, -0.6);
  Fogged scene;
  scene.fog += "<anisotropy>" + std::to_string(g) + "</anisotropy>";
  scene.objects = wall(-4, "black");
  const auto check = [&](const std::string& name, double wanted, double within = 0.01) {
    for (const std::string& isa : usable_isas()) {
      const Mean mean = mean_of(scene, isa);
      INFO(name << ", g " << g << ", " << isa << ": " << mean.red << " for " << wanted);
      CHECK(std::abs(mean.red / wanted - 1) < within);
      CHECK(std::abs(mean.green / mean.red - 0.5) < 1e-4);
      CHECK(mean.blue == 0);
    }
  };
  SECTION("of a directional light from above") {
    // Which comes to all of the ray through the same way in fog: 50 to its top would be dark, so 1.
    scene.box = "<box><min x='-50' y='-50' z='-3'/><max x='50' y='1' z='2'/><material>fog</material></box>";
    scene.lights =
        "<directionallights><directionallight><direction x='0' y='1' z='0'/><scaleradiance>4</scaleradiance>"
        "</directionallight></directionallights>";
    check("directional", along_ray([&](double) { return 4 * std::exp(-1 / mean_free_path) * phase(0, g); }));
  }
  SECTION("of a point light beside the ray, with and without fall-off") {
    const std::string falloff = GENERATE("none", "inversesquare");
    scene.lights =
        "<pointlights><pointlight><location x='0.3' y='0' z='0'/><scaleradiance>4</scaleradiance>"
        "<falloff>" +
        falloff + "</falloff></pointlight></pointlights>";
    check(falloff, along_ray([&](double z) {
            const double distance = std::hypot(0.3, z), cosine = z / distance;
            const double arriving = 4 * std::exp(-distance / mean_free_path) * phase(cosine, g);
            return falloff == "none" ? arriving : arriving / (distance * distance);
          }));
  }
  SECTION("of a spotlight whose cone the ray crosses, of one that it leaves, of one around it") {
    const auto [lookat, x] = GENERATE(table<std::string, double>(
        {{"x='-1' y='0' z='0'", 1.0}, {"x='0.9' y='0' z='-1'", 1.0}, {"x='0' y='0' z='-1'", 0.0}}));
    const double z0 = x == 0 ? 1.9 : 0;
    scene.lights = "<spotlights><spotlight><location x='" + std::to_string(x) + "' y='0.01' z='" + std::to_string(z0) +
                   "'/><lookat " + lookat +
                   "/><coneangle>100</coneangle><penumbraangle>10</penumbraangle>"
                   "<scaleradiance>4</scaleradiance><falloff>inversesquare</falloff></spotlight></spotlights>";
    double ax = -1, az = -1;
    if (x == 0) ax = 0, az = -2.9;
    if (lookat[3] == '-') ax = -2, az = 0;
    if (lookat[3] == '0' && x != 0) ax = -0.1, az = -1;
    const double ay = -0.01, axis = std::sqrt(ax * ax + ay * ay + az * az);
    const double edge = std::cos(50 * std::numbers::pi / 180), inner = std::cos(40 * std::numbers::pi / 180);
    check(lookat, along_ray([&](double z) {
            const double dx = -x, dy = -0.01, dz = z - z0, distance = std::sqrt(dx * dx + dy * dy + dz * dz);
            const double above = (dx * ax + dy * ay + dz * az) / (distance * axis) - edge;
            if (above < 0) return 0.0;
            const double s = std::min(above / (inner - edge), 1.0);
            return 4 * std::exp(-distance / mean_free_path) * phase(dz / distance, g) * s * s * (3 - 2 * s) /
                   (distance * distance);
          }),
          0.015);
  }
  SECTION("of a lamp with a size, which paths come to as well") {
    // Far enough away that it is a point.
    scene.objects +=
        "<spheres><sphere><center x='1' y='0' z='0'/><radius>0.05</radius><material>lamp</material></sphere></spheres>";
    const double intensity = 3 * std::numbers::pi * 0.05 * 0.05;
    check("lamp", along_ray([&](double z) {
            const double distance = std::hypot(1, z);
            return intensity * std::exp(-distance / mean_free_path) * phase(z / distance, g) / (distance * distance);
          }),
          0.02);
  }
  SECTION("of one of a hundred lights, with a shadow") {
    // Behind a screen; the hundredth shines past it.
    std::string lights = "<pointlights>";
    for (int i = 0; i < 99; ++i)
      lights += "<pointlight><location x='2' y='" + std::to_string(i * 0.01) + "' z='0'/></pointlight>";
    scene.lights = lights +
                   "<pointlight><location x='-1' y='0' z='0'/><scaleradiance>4</scaleradiance></pointlight>"
                   "</pointlights>";
    scene.box += "<box><min x='1.5' y='-40' z='-40'/><max x='1.6' y='40' z='40'/><material>black</material></box>";
    check("hundred", along_ray([&](double z) {
            const double distance = std::hypot(1, z);
            return 4 * std::exp(-distance / mean_free_path) * phase(z / distance, g);
          }),
          0.1);
  }
}

TEST_CASE("under light of 1 from all around, white fog is 1") {
  Fogged scene;
  scene.fog = "<anisotropy>" + std::to_string(GENERATE(0.0, 0.5, -0.5)) + "</anisotropy>";
  scene.path = "<maxdepth>200</maxdepth>";
  scene.lights = GENERATE("", "<environmentlights><environmentlight/></environmentlights>");
  scene.background = scene.lights.empty() ? "<background red='1' green='1' blue='1'/>" : "";
  scene.box = "<box><min x='-1' y='-1' z='-1'/><max x='1' y='1' z='1'/><material>fog</material></box>";
  scene.free_path = "0.4";
  scene.samples = scene.lights.empty() ? 16 : 256;
  CHECK(std::abs(mean_of(scene).red - 1) < 0.005);
  // From inside, too.
  scene.eye = "<eye x='0' y='0' z='0.5'/><lookat x='0' y='0' z='0'/><fov>90</fov>";
  CHECK(std::abs(mean_of(scene).red - 1) < 0.005);
}

TEST_CASE("each scattering in fog counts for maxdepth") {
  // Of white fog without walls: each more scatters more, and together they are all.
  Fogged scene;
  scene.fog = "";
  scene.background = "<background red='1' green='1' blue='1'/>";
  scene.box = "<box><min x='-1' y='-1' z='-1'/><max x='1' y='1' z='1'/><material>fog</material></box>";
  scene.free_path = "0.5";
  scene.samples = 64;
  double last = 0;
  for (const int depth : {1, 2, 4, 8}) {
    scene.path = "<maxdepth>" + std::to_string(depth) + "</maxdepth><roulettedepth>1</roulettedepth>";
    const double now = mean_of(scene).red;
    INFO(depth << ": " << now << " after " << last);
    CHECK(now > last * 1.05);
    if (depth == 1) CHECK(std::abs(now - std::exp(-4.0)) < 0.005);
    CHECK(now < 1);
    last = now;
  }
}

TEST_CASE("light that comes to surfaces through fog is what it leaves, from lights of all kinds") {
  Fogged scene;
  scene.fog = "<color red='0' green='0' blue='0'/>";
  scene.objects = wall(-4, "grey");
  scene.eye = "<eye x='0' y='0' z='-3.5'/><lookat x='0' y='0' z='-4'/><fov>0.01</fov>";
  scene.lights = GENERATE(
      "<pointlights><pointlight><location x='0' y='0' z='3'/></pointlight></pointlights>",
      "<directionallights><directionallight><direction x='0' y='0' z='1'/></directionallight></directionallights>",
      "<directionallights><directionallight><direction x='0' y='0' z='1'/><angle>0.5</angle></directionallight>"
      "</directionallights>");
  scene.samples = 16;
  const double through = mean_of(scene).green;
  scene.box = "";
  const double without = mean_of(scene).green;
  INFO(scene.lights << ": " << through << " of " << without);
  CHECK(std::abs(through / without / std::exp(-5 / mean_free_path) - 1) < 1e-3);
}

TEST_CASE("lamps with a size and skies light what is behind fog by what it leaves") {
  Fogged scene;
  scene.fog = "<color red='0' green='0' blue='0'/>";
  scene.eye = "<eye x='0' y='0' z='-3.5'/><lookat x='0' y='0' z='-4'/><fov>0.01</fov>";
  scene.objects =
      wall(-4, "grey") +
      "<spheres><sphere><center x='0' y='0' z='4'/><radius>0.3</radius><material>lamp</material></sphere></spheres>";
  const double through = mean_of(scene).green;
  scene.box = "";
  const double without = mean_of(scene).green;
  INFO(through << " of " << without);
  CHECK(std::abs(through / without / std::exp(-5 / mean_free_path) - 1) < 0.01);
}

TEST_CASE("fog that ends at the walls of a room is that which goes on behind them") {
  const auto room = [](double reach) {
    const std::string end = std::to_string(reach);
    return parsed_scene(
        "<raytracer><viewplane><hres>24</hres><vres>24</vres><samples>256</samples></viewplane><camera>"
        "<eye x='0' y='0.9' z='0'/><lookat x='0.3' y='0' z='-0.7'/><fov>80</fov></camera><integrator><path/>"
        "</integrator><lights><pointlights><pointlight><location x='0.2' y='0.5' z='-0.3'/><falloff>inversesquare"
        "</falloff></pointlight></pointlights></lights><materials><mattes><matte><name>grey</name><ka>0</ka>"
        "<kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/></matte></mattes><fogs><fog><name>fog</name>"
        "<meanfreepath>1</meanfreepath></fog></fogs></materials><objects><boxes><box><min x='-1' y='-1' z='-1'/>"
        "<max x='1' y='1' z='1'/><material>grey</material></box><box><min x='-" +
        end + "' y='-" + end + "' z='-" + end + "'/><max x='" + end + "' y='" + end + "' z='" + end +
        "'/><material>fog</material></box></boxes></objects></raytracer>");
  };
  const double at_walls = mean_of(rendered(room(1), 2)).red, behind = mean_of(rendered(room(1.5), 2)).red;
  INFO(at_walls << " and " << behind);
  CHECK(std::abs(at_walls / behind - 1) < 0.005);
}

TEST_CASE("fog that ends at what light comes through ends there") {
  Fogged scene;
  scene.materials =
      "<dielectrics><dielectric><name>pane</name><thinwalled>true</thinwalled></dielectric><dielectric><name>air</"
      "name><ior>1</ior></dielectric></dielectrics>";
  scene.lights = "<environmentlights><environmentlight/></environmentlights>";
  scene.fog = "";
  scene.path = "<maxdepth>300</maxdepth>";
  scene.box = "<box><min x='-2' y='-2' z='-2'/><max x='2' y='2' z='2'/><material>fog</material></box>";
  scene.eye = "<eye x='0.3' y='0.2' z='1'/><lookat x='0.1' y='0' z='-2'/><fov>20</fov>";
  scene.samples = 64;
  SECTION("at a pane, from inside and outside") {
    scene.objects = wall(-2, "pane");
    CHECK(std::abs(mean_of(scene).red - 1) < 0.01);
    scene.eye = "<eye x='0.3' y='0.2' z='-7'/><lookat x='0.1' y='0' z='-2'/><fov>20</fov>";
    CHECK(std::abs(mean_of(scene).red - 1) < 0.01);
  }
  SECTION("at all of a ball's surface, with the camera inside") {
    scene.box = "";
    scene.objects = "<spheres>";
    for (const std::string material : {"fog", "air"})
      scene.objects +=
          "<sphere><center x='0' y='0' z='0'/><radius>2</radius><material>" + material + "</material></sphere>";
    scene.objects += "</spheres>";
    CHECK(std::abs(mean_of(scene).red - 1) < 1e-4);
  }
}

TEST_CASE("fog that begins at a pane is behind it") {
  Fogged scene;
  scene.fog = "<color red='0' green='0' blue='0'/>";
  scene.path = "<maxdepth>3</maxdepth>";
  scene.materials =
      "<dielectrics><dielectric><name>pane</name><thinwalled>true</thinwalled><ior>1</ior></dielectric></dielectrics>";
  scene.objects = wall(-1, "lamp") + wall(2, "pane");
  scene.objects.replace(scene.objects.find("</rectangles><rectangles>"), 25, "");
  CHECK(std::abs(mean_of(scene).red - 3 * std::exp(-3 / mean_free_path)) < 0.01);
}

TEST_CASE("in a transparent picture fog covers what it does not let through") {
  Fogged scene;
  scene.background = "<background red='1' green='1' blue='1'/>";
  const SceneDescription description = parsed_scene(text_of(scene));
  const auto built = build_scene(description, {2, {}});
  RenderSettings settings{2, 0, whole(description)};
  settings.transparent = true;
  RayCounts rays;
  const Mean mean = mean_of(FloatPicture(render(*built, description, settings, rays)));
  INFO(mean.alpha);
  CHECK(std::abs(mean.alpha - (1 - std::exp(-5 / mean_free_path))) < 0.01);
  check_same_bits(description, true);
}

TEST_CASE("integrators other than paths do not know fog") {
  Fogged scene;
  scene.objects = wall(-4, "grey");
  scene.lights = "<pointlights><pointlight><location x='0' y='0' z='3'/></pointlight></pointlights>";
  scene.samples = 4;
  const auto with = [&](const std::string& integrator, const std::string& box) {
    Fogged changed = scene;
    changed.box = box;
    std::string text = text_of(changed);
    const std::string path = "<path>" + scene.path + "</path>";
    text.replace(text.find(path), path.size(), integrator);
    return rendered(parsed_scene(text));
  };
  const std::string integrator = GENERATE("<raycast/>", "<normals/>", "<ambientocclusion/>", "<albedo/>", "<uv/>");
  INFO(integrator);
  CHECK(identical(with(integrator, scene.box), with(integrator, "")));
}

TEST_CASE("caustics in fog are the same by paths from lights, photons and the camera") {
  const auto mean = [](const std::string& caustics) {
    Fogged scene;
    scene.lights = "";
    scene.fog = "<color red='0.8' green='0.8' blue='0.8'/>";
    scene.path = "<maxdepth>8</maxdepth><caustics>" + caustics + "</caustics>";
    scene.materials = "<dielectrics><dielectric><name>glass</name></dielectric></dielectrics>";
    scene.objects =
        wall(-2, "grey") +
        "<spheres><sphere><center x='0' y='0' z='-1'/><radius>0.8</radius><material>glass</material></sphere>"
        "<sphere><center x='0.5' y='0' z='3'/><radius>1.2</radius><material>lamp</material></sphere></spheres>";
    scene.box = "<box><min x='-3' y='-3' z='-3'/><max x='3' y='3' z='1'/><material>fog</material></box>";
    scene.free_path = "3";
    scene.eye = "<eye x='3' y='0.5' z='1.5'/><lookat x='0' y='0' z='-1.6'/><fov>50</fov>";
    scene.samples = caustics == "none" ? 4096 : 1024;
    return mean_of(scene).green;
  };
  const double none = mean("none"), light = mean("light"), photons = mean("photons");
  CHECK(std::abs(light / none - 1) < 0.01);
  CHECK(std::abs(photons / none - 1) < 0.015);
}

TEST_CASE("instances of fog are as fog in their places, be they shapes or meshes") {
  Fogged scene;
  scene.lights = "<pointlights><pointlight><location x='1' y='3' z='1'/></pointlight></pointlights>";
  scene.eye = "<eye x='0' y='1' z='5'/><lookat x='0' y='0' z='0'/><fov>40</fov>";
  scene.samples = 64;
  scene.box =
      "<box><min x='-1' y='-0.5' z='-1'/><max x='1' y='0.5' z='1'/><material>fog</material>"
      "<transform><rotate x='0' y='1' z='0' angle='30'/></transform></box>";
  const FloatPicture wanted = rendered(parsed_scene(text_of(scene)), 2);
  const auto check = [&](const std::string& group, const std::string& transform) {
    Fogged instances = scene;
    instances.box = "";
    std::string text = text_of(instances);
    text.replace(
        text.find("<boxes></boxes>"), 15,
        "<instances><instance><group>g</group><transform>" + transform + "</transform></instance></instances>");
    text.replace(text.find("</raytracer>"), 0,
                 "<groups><group><name>g</name><objects>" + group + "</objects></group></groups>");
    const FloatPicture found = rendered(parsed_scene(text), 2);
    double difference = 0;
    for (std::size_t i = 0; i < found.pixels().size(); ++i)
      difference += std::abs(double{found.pixels()[i].red} - double{wanted.pixels()[i].red});
    INFO(group << transform << ": " << difference);
    CHECK(difference < 0.02 * mean_of(wanted).red * static_cast<double>(found.pixels().size()));
  };
  const std::string turn = "<rotate x='0' y='1' z='0' angle='30'/>";
  check("<boxes><box><min x='-1' y='-0.5' z='-1'/><max x='1' y='0.5' z='1'/><material>fog</material></box></boxes>",
        turn);
  const std::string mesh =
      "<meshes><mesh><material>fog</material><positions>-1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 "
      "1 1"
      "</positions><faces>0 2 3  0 3 1  4 5 7  4 7 6  0 1 5  0 5 4  2 6 7  2 7 3  0 4 6  0 6 2  1 3 7  1 7 5</faces>"
      "</mesh></meshes>";
  check(mesh, "<scale x='1' y='0.5' z='1'/>" + turn);
}

TEST_CASE("fog has the same bits however its picture is cut") {
  // Two fogs, one in the other, with all kinds of lights, a cut-out, glass and a pane.
  check_same_bits(parsed_scene(
      "<raytracer><viewplane><hres>37</hres><vres>29</vres><samples>8</samples></viewplane><camera>"
      "<eye x='0' y='1' z='4'/><lookat x='0' y='0' z='0'/><fov>60</fov></camera><integrator><path>"
      "<caustics>light</caustics></path></integrator><lights><pointlights><pointlight><location x='1' y='2' z='0'/>"
      "<falloff>inversesquare</falloff></pointlight></pointlights><spotlights><spotlight>"
      "<location x='-2' y='2' z='1'/><lookat x='0' y='0' "
      "z='0'/><coneangle>40</coneangle></spotlight></spotlights><environmentlights>"
      "<environmentlight><color red='0.2' green='0.2' blue='0.3'/></environmentlight></environmentlights></lights>"
      "<materials><mattes><matte><name>grey</name><ka>0</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/>"
      "</matte><matte><name>thin</name><ka>0</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/>"
      "<opacity>0.5</opacity></matte></mattes><dielectrics><dielectric><name>glass</name></"
      "dielectric><dielectric><name>pane</name><thinwalled>true"
      "</thinwalled></dielectric></dielectrics>"
      "<emissives><emissive><name>lamp</name><ce red='3' green='3' blue='3'/></emissive></emissives>"
      "<fogs><fog><name>mist</name><meanfreepath>2</meanfreepath></fog><fog><name>smoke</name>"
      "<meanfreepath>0.5</meanfreepath><color red='0.6' green='0.7' blue='0.8'/><anisotropy>0.5</anisotropy></fog>"
      "</fogs></materials><objects><planes><plane><point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/>"
      "<material>grey</material></plane></planes><rectangles><rectangle><corner x='0.8' y='0' z='-2'/><edge1 x='0' "
      "y='1' z='0'/>"
      "<edge2 x='0' y='0' z='3'/><material>pane</material></rectangle></rectangles><spheres><sphere><center x='0.7' "
      "y='0' z='0'/><radius>0.5</radius>"
      "<material>glass</material></sphere><sphere><center x='-0.7' y='0' z='0'/><radius>0.6</radius>"
      "<material>smoke</material></sphere><sphere><center x='0' y='1' z='-1'/><radius>0.2</radius>"
      "<material>lamp</material></sphere><sphere><center x='0' y='0.3' z='0.8'/><radius>0.2</radius>"
      "<material>thin</material></sphere></spheres><boxes><box><min x='-2' y='-1' z='-2'/><max x='2' y='1.5' z='2'/>"
      "<material>mist</material></box></boxes></objects></raytracer>"));
}

}  // namespace raytrace::test
