// What is found to move while the shutter is open, and what is said about it.
#include "raytrace/description/motion.h"

#include <optional>
#include <string>
#include <utility>

#include "description/reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {

namespace {

/// scene_with() whose shutter is open for half a frame.
std::string open_shutter(const std::string& more) {
  std::string text = scene_with(more);
  return text.replace(text.find("</camera>"), 0, "<shutterclose>0.5</shutterclose>");
}

const std::string time_keys = "<time><key frame='1' value='0'/><key frame='25' value='1'/></time>";
const std::string move_keys =
    "<transform><translate><key frame='1' x='0' y='0' z='0'/><key frame='3' x='2' y='0' "
    "z='0'/></translate></transform>";

}  // namespace

TEST_CASE("animated files stand still while the shutter is open, as they are at the frame, with a warning") {
  for (const std::string type : {"mesh", "model"}) {
    INFO(type);
    const std::string objects = type == "mesh" ? "meshes" : "models";
    const auto scene = [&](const std::string& more) {
      return open_shutter("<objects><" + objects + "><" + type + "><file>fox.glb</file>" + more + "</" + type + "></" +
                          objects + "></objects>");
    };
    const std::string warning = "s:2:18: warning: the animation of this <" + type +
                                "> stands still while the shutter is open: its <time> counts at the frame\n";
    CHECK(reported(scene("<animation>0</animation>" + time_keys)) == warning);
    // Without an animation, the time is of nothing.
    CHECK(reported(scene(time_keys)).empty());

    const std::string moves = scene("<animation>0</animation>" + time_keys + move_keys);
    CHECK(reported(moves) == warning);
    const SceneDescription moving = accepted(moves);
    REQUIRE(std::get<ObjectItems<Instance>>(moving.objects).size() == 1);
    CHECK(std::get<ObjectItems<Instance>>(moving.objects)[0].motion.back().origin.x == 0.5);
    REQUIRE(moving.groups.size() == 1);
    const ObjectLists& own = moving.groups[0].objects;
    const double time = type == "mesh" ? std::get<ObjectItems<Mesh>>(own).at(0).parameters.time
                                       : std::get<ObjectItems<Model>>(own).at(0).parameters.time;
    CHECK(time == 0);
  }
}

TEST_CASE("a mesh in a group that instances move has its form of the frame") {
  const std::string text = open_shutter(
      "<objects><instances><instance><group>fox</group>" + move_keys + "</instance></instances></objects>" +
      "<groups><group><name>fox</name><objects><meshes><mesh><file>fox.glb</file><animation>Run</animation>" +
      time_keys + "</mesh></meshes></objects></group></groups>");
  CHECK(contains(reported(text), "stands still while the shutter is open"));
  CHECK(accepted(text).groups.size() == 1);
}

TEST_CASE("at one moment animations and materials are as at the frame, with a warning") {
  std::string text = scene_with("<objects><meshes><mesh><file>fox.glb</file><animation>0</animation>" + time_keys +
                                move_keys + "</mesh></meshes></objects>");
  text.replace(text.find("</camera>"), 0, "<shutteropen>0.5</shutteropen><shutterclose>0.5</shutterclose>");
  CHECK(
      reported(text) ==
      "s:2:18: warning: the animation of this <mesh> stands still while the shutter is open: its <time> counts at the "
      "frame\n");
  const SceneDescription scene = accepted(text);
  const auto& mesh = std::get<ObjectItems<Mesh>>(scene.objects).at(0);
  CHECK(mesh.parameters.time == 0);
  CHECK(mesh.transform.affine().origin.x == 0.5);
  CHECK(scene.groups.empty());
}

TEST_CASE("the warning that a material stands still has its name") {
  const std::string text = open_shutter(
      "<materials><mattes><matte><name>paint</name><ka>1</ka><kd><key frame='1' value='0'/><key frame='3' value='1'/>"
      "</kd><cd red='1' green='1' blue='1'/></matte></mattes></materials>");
  CHECK(reported(text) ==
        "s:2:20: warning: the material 'paint' stands still while the shutter is open: its keys count at the frame\n");
}

TEST_CASE("what is said of motion has a line and a column, also where a scene is one line") {
  const auto told = [](const std::string& more) {
    Diagnostics diagnostics("s");
    parse_scene(open_shutter(more), diagnostics);
    std::string text;
    for (const Diagnostic& one : diagnostics.kept()) {
      REQUIRE(one.location.line > 0);
      REQUIRE(one.location.column > 0);
      text += std::to_string(one.location.line) + ":" + std::to_string(one.location.column) + " " + one.message + "\n";
    }
    return text;
  };
  const std::string changing = "<key frame='1' value='1'/><key frame='2' value='2'/>";
  const std::string light = "<pointlight><location x='0' y='0' z='0'/><scaleradiance>" + changing +
                            "</scaleradiance><color red='1' green='1' blue='1'/></pointlight>";
  const std::string lights = told("<lights><pointlights>" + light + light + "</pointlights></lights>");
  const std::string stands = " this light stands still while the shutter is open: its keys count at the frame\n";
  CHECK(lights == "2:22" + stands + "2:" + std::to_string(22 + light.size()) + stands);
  CHECK(contains(told("<objects><spheres><sphere><center x='0' y='0' z='0'/><radius>" + changing +
                      "</radius><material>clay</material></sphere></spheres></objects>"),
                 "2:19 this <sphere> changes its form"));
  CHECK(contains(told("<objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/>"
                      "<material>clay</material>" +
                      move_keys + "</plane></planes></objects>"),
                 "2:18 a plane has no end"));
  CHECK(contains(told("<objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>clay</material>"
                      "<transform><scale><key frame='1' x='1' y='1' z='1'/><key frame='1.1' x='0' y='1' z='1'/></scale>"
                      "</transform></sphere></spheres></objects>"),
                 "while the shutter is open"));
}

TEST_CASE("that a scene stands still is said at the camera, which has the shutter") {
  const std::string text = open_shutter(
      "<objects><spheres><sphere><center><key frame='1' x='0' y='0' z='0'/>"
      "<key frame='2' x='1' y='0' z='0'/></center><radius>1</radius>"
      "<material>clay</material></sphere></spheres></objects>");
  SceneSettings settings;
  settings.still = true;
  Diagnostics diagnostics("s");
  CHECK(parse_scene(text, diagnostics, 1, settings));
  REQUIRE(diagnostics.kept().size() == 1);
  CHECK(diagnostics.kept()[0].severity == Severity::warning);
  CHECK(diagnostics.kept()[0].location.line == 1);
  CHECK(diagnostics.kept()[0].location.column == text.find("<camera>") + 1);
}

TEST_CASE("what is said of a camera's motion is said at the camera") {
  std::string text = open_shutter("<integrator><path><caustics>light</caustics></path></integrator>");
  const std::string eye = "<eye x=\"0\" y=\"0\" z=\"9\"/>";
  const std::size_t at = text.find(eye), camera = text.find("<camera>");
  REQUIRE(at != std::string::npos);
  text.replace(at, eye.size(), "<eye><key frame='1' x='0' y='0' z='9'/><key frame='2' x='1' y='0' z='9'/></eye>");
  CHECK(contains(reported(text), "s:1:" + std::to_string(camera + 1) + ": error: the camera moves while its shutter"));
}

TEST_CASE("a turn of more than 90 degrees from one moment to the next is an error, whole turns included") {
  const auto turning = [](double degrees) {
    return reported(open_shutter(
        "<objects><spheres><sphere><center x='2' y='0' z='0'/><radius>1</radius><material>clay</material><transform>"
        "<rotate><key frame='1' x='0' y='1' z='0' angle='0'/><key frame='1.5' x='0' y='1' z='0' angle='" +
        std::to_string(degrees) + "'/></rotate></transform></sphere></spheres></objects>"));
  };
  const std::string fact = "s:2:19: error: this <sphere> turns by ";
  for (const auto& [degrees, turn] : {std::pair(1441.0, "90.0625"), {2000.0, "125"}, {3600.0, "225"}, {5760.0, "360"}})
    CHECK(turning(degrees) == fact + turn +
                                  " degrees from one of the shutter's 17 moments to the next, too fast to be "
                                  "followed: 90 is the most; let the shutter be open for less time\n");
  CHECK(turning(-5760).substr(0, fact.size()) == fact);
  CHECK(contains(turning(1440), "s:2:19: warning: this <sphere> turns by 90 degrees"));
  CHECK(contains(turning(1440), "its blur has corners"));
  CHECK(turning(360).empty());
  CHECK(turning(90).empty());
}

TEST_CASE("a turn around the frame is measured from moment to moment") {
  std::string text = scene_with(
      "<objects><spheres><sphere><center x='2' y='0' z='0'/><radius>1</radius><material>clay</material><transform>"
      "<rotate><key frame='0.5' x='0' y='1' z='0' angle='-180'/><key frame='1.5' x='0' y='1' z='0' angle='180'/>"
      "</rotate></transform></sphere></spheres></objects>");
  text.replace(text.find("</camera>"), 0, "<shutteropen>-0.5</shutteropen><shutterclose>0.5</shutterclose>");
  CHECK(reported(text).empty());
}

TEST_CASE("two turns of one object that are too fast together are an error") {
  const std::string turn =
      "<rotate><key frame='1' x='0' y='1' z='0' angle='0'/><key frame='1.5' x='0' y='1' z='0' angle='800'/></rotate>";
  CHECK(contains(reported(open_shutter("<objects><spheres><sphere><center x='2' y='0' z='0'/><radius>1</radius>"
                                       "<material>clay</material><transform>" +
                                       turn + turn + "</transform></sphere></spheres></objects>")),
                 "s:2:19: error: this <sphere> turns, or is turned inside out, too fast"));
}

TEST_CASE("pixels that grow while the shutter is open are as a view distance that shrinks") {
  const auto with = [](const std::string& camera, const std::string& pixelsize) {
    return "<raytracer><viewplane><hres>4</hres><vres>4</vres>" + pixelsize + "</viewplane>" + camera + "</raytracer>";
  };
  const std::string keys = "<pixelsize><key frame='1' value='1'/><key frame='2' value='2'/></pixelsize>";
  const std::string ends = "<eye x='0' y='0' z='9'/><lookat x='0' y='0' z='0'/>";
  const std::string open = "<shutterclose>1</shutterclose>";
  const std::string pinhole = with("<camera>" + ends + "<viewdistance>60</viewdistance>" + open + "</camera>", keys);
  CHECK(reported(pinhole).empty());
  const SceneDescription scene = accepted(pinhole);
  REQUIRE(scene.moving_camera.size() == shutter_moments);
  CHECK(scene.viewplane.pixelsize == 1);
  CHECK(std::get<PinholeCamera::Parameters>(scene.moving_camera.front()).viewdistance == 60);
  CHECK(std::get<PinholeCamera::Parameters>(scene.moving_camera.back()).viewdistance == 30);
  const std::string stands =
      ": warning: the view plane stands still while the shutter is open: its keys count at the frame\n";
  const std::string orthographic = with("<orthographiccamera>" + ends + open + "</orthographiccamera>", keys);
  CHECK(reported(orthographic) == "s:1:" + std::to_string(orthographic.find("<ortho") + 1) + stands);
  const std::string background = with("<camera>" + ends + "<viewdistance>60</viewdistance>" + open + "</camera>",
                                      "<background><key frame='1' red='0' green='0' blue='0'/>"
                                      "<key frame='2' red='1' green='1' blue='1'/></background>");
  CHECK(reported(background) == "s:1:" + std::to_string(background.find("<camera") + 1) + stands);
}

TEST_CASE("objects of types without keys are read but once, and stay where they are") {
  const std::string still =
      "<objects><spheres><sphere><name>ball</name><center x='$place' y='0' z='0'/><radius>1</radius><material>clay"
      "</material></sphere></spheres><disks><disk><center><key frame='1' x='0' y='0' z='0'/><key frame='2' x='4' y='0' "
      "z='0'/></center><normal x='0' y='1' z='0'/><radius>1</radius><material>clay</material></disk></disks></objects>"
      "<groups><group><name>g</name><objects><spheres><sphere><center x='1' y='0' z='0'/><radius>1</radius><material>"
      "clay</material></sphere></spheres></objects></group></groups>";
  SceneSettings settings;
  settings.variables["place"] = "7";
  for (const bool instant : {false, true}) {
    std::string text = scene_with(still);
    text.replace(text.find("</camera>"), 0,
                 std::string(instant ? "<shutteropen>0.5</shutteropen>" : "") + "<shutterclose>0.5</shutterclose>");
    Diagnostics diagnostics("s");
    const std::optional<SceneDescription> scene = parse_scene(text, diagnostics, 1, settings);
    REQUIRE(scene);
    CHECK(diagnostics.kept().empty());
    REQUIRE(std::get<ObjectItems<Sphere>>(scene->objects).size() == 1);
    CHECK(std::get<ObjectItems<Sphere>>(scene->objects)[0].parameters.center.x == 7);
    REQUIRE(scene->groups.size() == (instant ? 1 : 2));
    CHECK(std::get<ObjectItems<Sphere>>(scene->groups[0].objects).size() == 1);
    if (instant)
      CHECK(std::get<ObjectItems<Disk>>(scene->objects).at(0).parameters.center.x == 2);
    else
      CHECK(std::get<ObjectItems<Instance>>(scene->objects).at(0).motion.back().origin.x == 2);
  }
}

}  // namespace raytrace::test
