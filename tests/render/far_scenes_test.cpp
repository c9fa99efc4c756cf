// Small things far from an origin, be it the world's or a group's, look as they do next to it.
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

constexpr double tiny = 0.01;
const Vec3d far_place{3000, 2000, -1000};
const Vec3d on_map{500000, 4000000, -300};

/// `sizes` away from the place, in sizes of the small things.
std::string beside(const char* element, const Vec3d& place, double x, double y, double z) {
  return vector_text(element, place.x + tiny * x, place.y + tiny * y, place.z + tiny * z);
}

/// A ball, a pyramid and a lamp on a slab, all of it about a place.
std::string small_things(const Vec3d& place) {
  const auto corner = [&](double x, double y, double z) {
    return std::to_string(place.x + tiny * x) + " " + std::to_string(place.y + tiny * y) + " " +
           std::to_string(place.z + tiny * z) + ", ";
  };
  return "<spheres><sphere>" + beside("center", place, 0, 0, 0) +
         "<radius>0.01</radius><material>white</material></sphere><sphere>" + beside("center", place, 2, 2.5, 2) +
         "<radius>0.005</radius><material>lamp</material></sphere></spheres><boxes><box>" +
         beside("min", place, -3, -1.5, -3) + beside("max", place, 3, -1, 3) +
         "<material>white</material></box></boxes><meshes><mesh><positions>" + corner(-2, -1, 1) + corner(-1, -1, 2) +
         corner(-1, -1, 0) + corner(-1.5, 1, 1) +
         "</positions><faces>0 1 3, 1 2 3, 2 0 3</faces><material>white</material></mesh></meshes>";
}

std::string far_scene(const std::string& objects, const Vec3d& place, const std::string& groups = {},
                      const std::string& shutter = {}) {
  return scene_text(
      48, 36, 64,
      "<integrator><path><maxdepth>5</maxdepth></path></integrator><materials><mattes><matte><name>white</name>"
      "<ka>0</ka><kd>0.8</kd><cd red='1' green='1' blue='1'/></matte></mattes><emissives><emissive><name>lamp</name>"
      "<ce red='8' green='8' blue='8'/></emissive></emissives></materials><objects>" +
          objects + "</objects><groups>" + groups + "</groups>",
      beside("eye", place, 0.5, 1, 5) + beside("lookat", place, 0, 0, 0) + shutter);
}

double mean_light(const std::string& scene) { return mean_green(rendered(scene)); }

/// A camera that looks somewhere, at a point that is so far away.
std::string view(double x, double length) {
  return vector_text("eye", x, 0.5, 0.75) + vector_text("lookat", x - 0.25 * length, 0.5 - 0.5 * length, 0.75 - length);
}

}  // namespace

TEST_CASE("small things far from the origin have the light that they have at it") {
  const Vec3d origin{0, 0, 0};
  const double near = mean_light(far_scene(small_things(origin), origin));
  CHECK(std::abs(mean_light(far_scene(small_things(far_place), far_place)) / near - 1) < 1e-3);
  // There is more in the scene than they are: how close the camera is to what it looks at counts.
  const std::string other =
      "<disks><disk><center x='0' y='0' z='-9000'/><normal x='1' y='0' z='0'/><radius>0.1</radius>"
      "<material>white</material></disk></disks>";
  CHECK(std::abs(mean_light(far_scene(other + small_things(far_place), far_place)) / near - 1) < 1e-3);
}

TEST_CASE("small things far from the origin of their group have the light that they have at it") {
  const Vec3d origin{0, 0, 0};
  const auto group = [](const std::string& objects) {
    return "<group><name>g</name><objects>" + objects + "</objects></group>";
  };
  const auto instance = [](const std::string& steps) {
    return "<instances><instance><group>g</group><transform>" + steps + "</transform></instance></instances>";
  };
  const std::string back = vector_text("translate", -on_map.x, -on_map.y, -on_map.z);
  const double near =
      mean_light(far_scene(instance("<translate x='0' y='0' z='0'/>"), origin, group(small_things(origin))));
  CHECK(std::abs(mean_light(far_scene(instance(back), origin, group(small_things(on_map)))) / near - 1) < 1e-3);
  // What is small is a part of what is larger.
  const auto with_other = [&](const Vec3d& place) {
    return group(small_things(place) + "<spheres><sphere>" +
                 vector_text("center", place.x + 90, place.y, place.z + 90) +
                 "<radius>2</radius><material>white</material></sphere></spheres>");
  };
  for (const Vec3d& place : {on_map, Vec3d(6000, 0, 0)}) {
    INFO("at x = " << place.x);
    const std::string from = vector_text("translate", -place.x, -place.y, -place.z);
    CHECK(std::abs(mean_light(far_scene(instance(from), origin, with_other(place))) / near - 1) < 2e-3);
  }

  // In motion.
  const std::string
      open = "<shutteropen>0</shutteropen><shutterclose>1</shutterclose>",
      moves = "<translate><key frame='1' x='0' y='0' z='0'/><key frame='2' x='0.01' y='0' z='0'/></translate>";
  const double moving = mean_light(far_scene(instance(moves), origin, group(small_things(origin)), open));
  CHECK(std::abs(mean_light(far_scene(instance(back + moves), origin, group(small_things(on_map)), open)) / moving -
                 1) < 1e-3);
}

TEST_CASE("shapes far from the origin of their own space look as next to it") {
  // Stretched, so that rays follow the transform; turned, so that coordinates are those before it.
  const std::string steps = GENERATE("<scale x='1' y='2' z='1'/>", "<rotate x='1' y='1' z='0' angle='40'/>");
  const std::string integrator = GENERATE("<uv/>", "<albedo/>");
  const bool in_group = GENERATE(false, true);
  const auto seen = [&](const Vec3d& place) {
    const std::string transform =
        "<transform>" + vector_text("translate", -place.x, -place.y, -place.z) + steps + "</transform>";
    const std::string material = "<material>cubes</material>" + (in_group ? "" : transform);
    const std::string shapes = "<spheres><sphere>" + vector_text("center", place.x + 0.9, place.y, place.z) +
                               "<radius>1</radius>" + material + "</sphere></spheres><cylinders><cylinder>" +
                               vector_text("bottom", place.x - 1.5, place.y - 0.3, place.z) +
                               vector_text("top", place.x - 1, place.y + 0.5, place.z) + "<radius>0.4</radius>" +
                               material + "</cylinder></cylinders>";
    return rendered(scene_text(
        48, 36, 4,
        "<integrator>" + integrator +
            "</integrator><textures><checkers><checker><name>cubes</name><scale>0.7</scale><space>object</space>"
            "</checker></checkers></textures><materials><mattes><matte><name>cubes</name><ka>0</ka><kd>1</kd>"
            "<cd texture='cubes'/></matte></mattes></materials>" +
            (in_group ? "<groups><group><name>g</name><objects>" + shapes +
                            "</objects></group></groups><objects><instances><instance><group>g</group>" + transform +
                            "</instance></instances></objects>"
                      : "<objects>" + shapes + "</objects>"),
        "<eye x='1' y='1' z='3'/><lookat x='0' y='0' z='0'/>"));
  };
  // Whole squares away, and no farther than where the floats that textures look up by still know where they end.
  const Vec3d place = integrator == "<uv/>" ? on_map : Vec3d(4200, -2800, 1400);
  const FloatPicture near = seen({0, 0, 0}), far = seen(place);
  double sum = 0;
  for (std::size_t i = 0; i < near.pixels().size(); ++i) sum += difference(near.pixels()[i], far.pixels()[i]);
  INFO(steps << ", " << integrator << (in_group ? ", in a group" : ""));
  CHECK(sum / static_cast<double>(near.pixels().size()) < 2e-3);
}

TEST_CASE("textures do not jump where the origin does") {
  // The closer the point that the camera looks at, the sooner it takes the origin along.
  const auto seen = [](double x, double length) {
    return rendered(scene_text(
        48, 36, 4,
        "<integrator><albedo/></integrator><textures><checkers><checker><name>cubes</name><scale>0.3</scale></checker>"
        "</checkers><noises><noise><name>clouds</name><scale>0.25</scale></noise></noises></textures><materials>"
        "<mattes><matte><name>cubes</name><ka>0</ka><kd>1</kd><cd texture='cubes'/></matte><matte><name>clouds</name>"
        "<ka>0</ka><kd>1</kd><cd texture='clouds'/></matte></mattes></materials><objects><planes><plane>"
        "<point x='0' y='-0.35' z='0'/><normal x='0' y='1' z='0'/><material>clouds</material></plane></planes><spheres>"
        "<sphere>" +
            vector_text("center", x, 0, 0) +
            "<radius>0.4</radius><material>cubes</material></sphere></spheres></objects>",
        view(x, length)));
  };
  const FloatPicture fixed = seen(80, 1), taken_along = seen(80, 0.5);
  double different = 0;
  for (std::size_t i = 0; i < fixed.pixels().size(); ++i)
    different += difference(fixed.pixels()[i], taken_along.pixels()[i]) > 1e-3 ? 1 : 0;
  CHECK(different / static_cast<double>(fixed.pixels().size()) < 0.01);
}

}  // namespace raytrace::test
