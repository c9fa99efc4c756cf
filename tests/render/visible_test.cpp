// Objects that are not visible to the camera: its own rays pass them, all others meet them.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "render/fogged.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

const std::string invisible = "<visible>false</visible>";

/// Lights that throw no shadows, so that what is invisible is nowhere in the picture.
const std::string shadowless =
    "<ambientlight/><pointlights><pointlight><location x='2' y='4' z='9'/><shadows>false</shadows></pointlight>"
    "</pointlights>";
const std::string materials =
    "<mattes><matte><name>grey</name><ka>0.5</ka><kd>0.5</kd><cd red='1' green='0.8' blue='0.6'/></matte>"
    "<matte><name>red</name><ka>0.5</ka><kd>0.5</kd><cd red='1' green='0' blue='0'/></matte>"
    "<matte><name>veil</name><ka>0.5</ka><kd>0.5</kd><cd red='0' green='0' blue='1'/><opacity>0.5</opacity></matte>"
    "</mattes><emissives><emissive><name>lamp</name><ce red='9' green='9' blue='9'/></emissive></emissives>"
    "<mirrors><mirror><name>mirror</name><cr red='0.9' green='0.9' blue='0.9'/></mirror></mirrors>"
    "<dielectrics><dielectric><name>glass</name></dielectric></dielectrics>"
    "<fogs><fog><name>mist</name><meanfreepath>6</meanfreepath></fog><fog><name>soot</name><meanfreepath>0.7"
    "</meanfreepath><color red='0' green='0' blue='0'/></fog></fogs>";

std::string scene(const std::string& integrator, const std::string& objects, const std::string& groups = {},
                  const std::string& lights = shadowless, int samples = 4) {
  return scene_text(37, 29, samples,
                    "<integrator>" + integrator + "</integrator><lights>" + lights + "</lights><materials>" +
                        materials + "</materials><groups>" + groups + "</groups><objects>" + objects + "</objects>");
}

/// What the camera sees: a torus, which comes last of all shapes' types but few, half behind a veil.
const std::string seen =
    "<spheres><sphere><name>ball</name><center x='0' y='0' z='0'/><radius>2</radius><material>grey</material></sphere>"
    "</spheres><rectangles><rectangle><corner x='0' y='-3' z='3'/><edge1 x='4' y='0' z='0'/><edge2 x='0' y='6' z='0'/>"
    "<material>veil</material></rectangle></rectangles>";

std::string sphere(double x, double y, double z, double radius, const std::string& material, const std::string& more) {
  return "<spheres><sphere>" + vector_text("center", x, y, z) + "<radius>" + std::to_string(radius) +
         "</radius><material>" + material + "</material>" + more + "</sphere></spheres>";
}

/// Objects of all kinds before the camera's eye, and the groups that they need.
struct Hidden {
  std::string name, objects, groups = {};
};
std::vector<Hidden> hidden_objects() {
  const std::string box = "<min x='-4' y='-3' z='4'/><max x='4' y='4' z='5'/><material>red</material>";
  const std::string turn = "<transform><rotate x='0' y='1' z='1' angle='9'/></transform>";
  const auto group = [&](const std::string& more) {
    return "<group><name>g</name><objects><boxes><box>" + box + more + "</box><box>" + box + turn + more +
           "</box></boxes></objects></group>";
  };
  const auto instance = [](const std::string& more) {
    return "<instances><instance><group>g</group><transform><scale x='1' y='0.9' z='1'/></transform>" + more +
           "</instance></instances>";
  };
  return {
      {"a sphere behind the seen one in the file", sphere(0, 1, 6, 3, "red", invisible)},
      {"a box", "<boxes><box>" + box + invisible + "</box></boxes>"},
      {"a box under a transform", "<boxes><box>" + box + turn + invisible + "</box></boxes>"},
      {"a plane", "<planes><plane><point x='0' y='0' z='6'/><normal x='0' y='0' z='1'/><material>red</material>" +
                      invisible + "</plane></planes>"},
      {"a triangle",
       "<triangles><triangle><vertexposition1 x='-4' y='-3' z='5'/><vertexposition2 x='4' y='-3' z='5'/>"
       "<vertexposition3 x='0' y='6' z='5'/><material>red</material>" +
           invisible + "</triangle></triangles>"},
      {"a mesh",
       "<meshes><mesh><positions>-4 -3 5, 4 -3 5, 4 6 5, -4 6 4</positions><faces>0 1 2 3</faces>"
       "<material>red</material>" +
           invisible + "</mesh></meshes>"},
      {"an instance", instance(invisible), group("")},
      {"objects in a group", instance(""), group(invisible)},
      {"an instance in a group", "<instances><instance><group>outer</group></instance></instances>",
       group("") + "<group><name>outer</name><objects>" + instance(invisible) + "</objects></group>"},
      {"a group in an instance", "<instances><instance><group>outer</group>" + invisible + "</instance></instances>",
       group("") + "<group><name>outer</name><objects>" + instance("") + "</objects></group>"},
      // It comes first at equal distances.
      {"a plane in the place of the veil",
       "<planes><plane><point x='0' y='0' z='3'/><normal x='0' y='0' z='1'/><material>red</material>" + invisible +
           "</plane></planes>"},
  };
}

/// Across the view.
std::string rectangle(double z, const std::string& material) {
  return "<rectangles><rectangle><corner x='-60' y='-60' z='" + std::to_string(z) +
         "'/><edge1 x='120' y='0' z='0'/><edge2 x='0' y='120' z='0'/><material>" + material +
         "</material></rectangle></rectangles>";
}

/// A lamp that shines towards -z.
std::string lamp_from(double z) {
  return "<rectangles><rectangle><corner x='-60' y='-60' z='" + std::to_string(z) +
         "'/><edge1 x='0' y='120' z='0'/><edge2 x='120' y='0' "
         "z='0'/><material>lamp</material></rectangle></rectangles>";
}

bool same_values(const ImageBand& a, const ImageBand& b) { return a.planes == b.planes; }

}  // namespace

TEST_CASE("pictures and AOVs are as if what the camera does not see were not there") {
  const std::vector<std::string> aovs = {"depth", "normal", "albedo", "position", "material_id", "crypto_object"};
  for (const std::string integrator : {"<raycast/>", "<normals/>", "<uv/>", "<albedo/>", "<path/>"}) {
    const bool by_paths = integrator == "<path/>";
    const std::string without = scene(integrator, seen);
    const FloatPicture picture = rendered(without);
    for (const std::string& isa : usable_isas()) {
      const FloatPicture its_picture = rendered(parsed_scene(without), 1, isa);
      const ImageBand values = picture_aovs(parsed_scene(without), aovs, isa);
      for (const Hidden& hidden : hidden_objects()) {
        INFO(integrator << ": " << hidden.name << ", " << isa);
        const std::string with = scene(integrator, seen + hidden.objects, hidden.groups);
        // Paths meet it on their ways from surface to surface.
        if (!by_paths) CHECK(identical(rendered(parsed_scene(with), 1, isa), its_picture));
        CHECK(same_values(picture_aovs(parsed_scene(with), aovs, isa), values));
      }
    }
    for (const Hidden& hidden : hidden_objects()) {
      INFO(integrator << ": " << hidden.name);
      const std::string with = scene(integrator, seen + hidden.objects, hidden.groups);
      std::string shown = with;
      for (std::size_t at = 0; (at = shown.find(invisible)) != std::string::npos;) shown.erase(at, invisible.size());
      CHECK_FALSE(identical(rendered(shown), picture));
    }
  }
}

TEST_CASE("models and clouds of spheres may be invisible to the camera") {
  const TemporaryFolder folder;
  const std::string obj = folder.file("wall.obj"), ply = folder.file("dots.ply");
  std::ofstream(obj) << "o a\nv -4 -3 5\nv 4 -3 5\nv 4 6 5\nv -4 6 5\nf 1 2 3 4\n";
  std::ofstream(ply) << "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n-1 0 5\n1 1 5\n";
  const FloatPicture picture = rendered(scene("<raycast/>", seen));
  const std::string model = "<models><model><file>" + obj + "</file>";
  const std::string cloud = "<sphereclouds><spherecloud><file>" + ply +
                            "</file><radius>1</radius><material>red"
                            "</material>";
  for (const bool is_visible : {false, true}) {
    const std::string more = is_visible ? "" : invisible;
    CHECK(identical(rendered(scene("<raycast/>", seen + model + more + "</model></models>")), picture) == !is_visible);
    CHECK(identical(rendered(scene("<raycast/>", seen + cloud + more + "</spherecloud></sphereclouds>")), picture) ==
          !is_visible);
  }
}

TEST_CASE("where the camera has nothing before it but what it does not see, alpha is 0") {
  const SceneDescription description = parsed_scene(scene("<raycast/>", sphere(0, 0, 0, 3, "grey", invisible)));
  RenderSettings settings{1, 0, whole(description)};
  settings.transparent = true;
  RayCounts rays;
  const FloatPicture picture = render(*build_scene(description, {1, {}}), description, settings, rays);
  for (const Pixel& pixel : picture.pixels()) CHECK(pixel.alpha == 0);
}

TEST_CASE("mirrors, shadows and light from surface to surface know nothing of what the camera does not see") {
  // Nothing but the floor and the mirror is before the camera: so it makes no difference, to the last bit.
  const std::string room =
      "<planes><plane><point x='0' y='-2' z='0'/><normal x='0' y='1' z='0'/><material>grey</material></plane></planes>"
      "<rectangles><rectangle><corner x='-5' y='-2' z='-3'/><edge1 x='10' y='0' z='0'/><edge2 x='0' y='9' z='0'/>"
      "<material>mirror</material></rectangle></rectangles>";
  const std::string sun =
      "<directionallights><directionallight><direction x='0.1' y='1' z='1.2'/></directionallight></directionallights>";
  const auto behind = [&](const std::string& more) {
    return sphere(-3, 1, 16, 2, "red", more) + sphere(3, 2, 17, 2, "lamp", more) +
           "<boxes><box><min x='-1' y='-2' z='14'/><max x='1' y='4' z='15'/><material>glass</material>"
           "<transform><rotate x='0' y='1' z='0' angle='3'/></transform>" +
           more +
           "</box></boxes><meshes><mesh><positions>-9 6 -3, 9 6 -3, 9 6 14, -9 6 14</positions><faces>0 1 2 3</faces>"
           "<material>red</material>" +
           more + "</mesh></meshes>";
  };
  for (const std::string integrator : {"<raycast/>", "<path/>", "<ambientocclusion/>"}) {
    const FloatPicture picture = rendered(scene(integrator, room + behind(""), "", sun, 16));
    CHECK(identical(rendered(scene(integrator, room + behind(invisible), "", sun, 16)), picture));
    CHECK_FALSE(identical(rendered(scene(integrator, room, "", sun, 16)), picture));
  }
}

TEST_CASE("a lamp that the camera does not see lights what is behind it") {
  const auto floor_and_lamp = [&](const std::string& more) {
    return scene("<path><maxdepth>1</maxdepth></path>",
                 "<planes><plane><point x='0' y='-2' z='0'/><normal x='0' y='1' z='0'/><material>grey</material>"
                 "</plane></planes>" +
                     sphere(0, 0, 4, 1.5, "lamp", more),
                 "", "", 1);
  };
  const FloatPicture hidden = rendered(floor_and_lamp(invisible)), shown = rendered(floor_and_lamp(""));
  int lamps = 0, wrong = 0;
  for (std::size_t i = 0; i < hidden.pixels().size(); ++i) {
    const Pixel &a = hidden.pixels()[i], &b = shown.pixels()[i];
    if (b.blue > 8.9F) {
      ++lamps;  // there, the floor or the background
      wrong += a.blue > 8 || !(a.blue > 0);
    } else {
      wrong += !identical(a, b);
    }
  }
  CHECK(lamps > 50);
  CHECK(wrong == 0);
}

TEST_CASE("fog that the camera does not see dims what lights are seen by, but not what the camera sees") {
  Fogged scene;
  scene.box.insert(scene.box.find("</box>"), invisible);
  scene.objects = rectangle(-4, "lamp");
  CHECK(std::abs(mean_of(scene).green - 3) < 1e-6);
  // Inside of it, a wall under a light whose way is 2 long, or one in a mirror's image.
  const std::string lamp = "<pointlights><pointlight><location x='0' y='0' z='1'/></pointlight></pointlights>";
  scene.objects = rectangle(-1, "grey");
  scene.lights = lamp;
  const double dim = mean_of(scene).green;
  scene.lights.insert(scene.lights.find("</pointlight>"), "<shadows>false</shadows>");
  CHECK(std::abs(mean_of(scene).green - dim) < 1e-6);
  CHECK(std::abs(dim - 0.5 / std::acos(-1.0) * std::exp(-2 / mean_free_path)) < 1e-3);
  // With the eye in it, too, and behind the boundary of something clear that is not there.
  scene.eye = "<eye x='0' y='0' z='1.5'/><lookat x='0' y='0' z='0'/><fov>0.01</fov>";
  CHECK(std::abs(mean_of(scene).green - dim) < 1e-6);
  // Where a path goes on, it is in the fog: what it meets there is as dim as where it is seen.
  Fogged mirrored;
  mirrored.fog = "<color red='0' green='0' blue='0'/>";
  mirrored.path = "";
  mirrored.materials = "<mirrors><mirror><name>mirror</name><cr red='1' green='1' blue='1'/></mirror></mirrors>";
  mirrored.box =
      "<box><min x='-50' y='-50' z='-3'/><max x='50' y='50' z='2'/><material>fog</material>" + invisible + "</box>";
  mirrored.objects = rectangle(-1, "mirror") + lamp_from(7);
  CHECK(std::abs(mean_of(mirrored).green - 3 * std::exp(-3 / mean_free_path)) < 0.01);
  mirrored.eye = "<eye x='0' y='0' z='1'/><lookat x='0' y='0' z='0'/><fov>0.01</fov>";
  mirrored.objects = rectangle(-1, "mirror") + lamp_from(1.5);  // which ends in the fog
  CHECK(std::abs(mean_of(mirrored).green - 3 * std::exp(-2.5 / mean_free_path)) < 0.01);
}

TEST_CASE("what is inside of clear things that the camera does not see is as dim as they make it") {
  // From a mirror in amber to a lamp in it, two away; the camera sees the mirror as if there were no amber.
  const std::string mirror_and_lamp = rectangle(-1, "mirror") + lamp_from(1);
  const auto seen_from = [&](const std::string& z, const std::string& box, const std::string& objects) {
    return mean_green(rendered(
        "<raytracer><viewplane><hres>4</hres><vres>4</vres><samples>16</samples></viewplane><camera><eye x='0' y='0' "
        "z='" +
        z + "'/><lookat x='0' y='0' z='-9'/><fov>0.01</fov></camera><integrator><path/></integrator><materials>" +
        materials +
        "<dielectrics><dielectric><name>amber</name><priority>1</priority><attenuationcolor red='0.5' green='0.5' "
        "blue='0.5'/>"
        "<attenuationdistance>1</attenuationdistance></dielectric></dielectrics></materials><objects>" +
        objects + "<boxes><box><min x='-50' y='-50' z='-3'/><max x='50' y='50' z='3'/><material>amber</material>" +
        box + "</box></boxes></objects></raytracer>"));
  };
  // What the camera sees behind the boundary of something that is not there, inside of what counts more.
  const std::string unseen = rectangle(0, "grey").insert(rectangle(0, "grey").find("</rectangle>"), invisible);
  const std::string inner =
      "<boxes><box><min x='-40' y='-40' z='-0.5'/><max x='40' y='40' z='0.5'/><material>glass"
      "</material></box></boxes>";
  CHECK(std::abs(seen_from("0.9", "", rectangle(-1, "lamp") + unseen + inner) - 9 * std::pow(0.5, 1.9)) < 1e-4);
  CHECK(std::abs(seen_from("0.9", invisible, mirror_and_lamp) - 9 * 0.9 * 0.25) < 1e-4);
  CHECK(std::abs(seen_from("0", "", mirror_and_lamp) - 9 * 0.9 * 0.25 * 0.5) < 1e-4);
}

TEST_CASE("what the camera does not see leaves no trace of how a picture is cut") {
  const std::string lights =
      "<pointlights><pointlight><location x='3' y='7' z='6'/></pointlight></pointlights><environmentlights>"
      "<environmentlight><scaleradiance>0.3</scaleradiance></environmentlight></environmentlights>";
  std::string objects = seen +
                        "<planes><plane><point x='0' y='-2' z='0'/><normal x='0' y='1' z='0'/><material>grey"
                        "</material></plane></planes>" +
                        sphere(2, 3, 2, 0.7, "lamp", invisible);
  for (int i = 0; i < 6; ++i)
    objects += sphere(i - 3.0, i % 3, 4 - i % 2, 0.6, i % 2 == 0 ? "glass" : "red", i % 3 == 0 ? "" : invisible);
  for (const std::string caustics : {"light", "photons"})
    check_same_bits(parsed_scene(scene("<path><caustics>" + caustics + "</caustics></path>", objects, "", lights, 8)),
                    caustics == "light");
  // Paths that the fog scatters are next to such as see through the glass.
  objects += "<boxes><box><min x='-4' y='-2' z='-4'/><max x='4' y='5' z='6'/><material>mist</material></box></boxes>";
  check_same_bits(parsed_scene(scene("<path/>", objects, "", lights, 8)), true);
}

TEST_CASE("an invisible object far away changes nothing of what media paths are in") {
  // Both fogs are everywhere before the wall; the one that paths came into last counts.
  const auto fog = [](double near, const std::string& material) {
    return "<boxes><box><min x='-50' y='-50' z='-9'/><max x='50' y='50' z='" + std::to_string(near) + "'/><material>" +
           material + "</material></box></boxes>";
  };
  const std::string lights = "<pointlights><pointlight><location x='0' y='0' z='5'/></pointlight></pointlights>";
  const std::string objects = fog(7, "soot") + fog(6, "mist") + rectangle(-3, "grey");
  const std::string glass = sphere(0, -400, 0, 0.1, "glass", ""), grey = sphere(0, -400, 0, 0.1, "grey", "");
  for (const std::string& far : {glass, grey}) {
    std::string hidden = far;
    hidden.insert(hidden.find("</sphere>"), invisible);
    CHECK(identical(rendered(scene("<path/>", objects + hidden, "", lights)),
                    rendered(scene("<path/>", objects + far, "", lights))));
  }
}

}  // namespace raytrace::test
