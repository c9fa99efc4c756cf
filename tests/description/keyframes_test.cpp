// <key> in the values of a scene: what they are between the keys, and what is refused.
#include "raytrace/description/keyframes.h"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

constexpr Interpolation linear = Interpolation::linear;
constexpr Interpolation smooth = Interpolation::smooth;

double at(double frame, const std::vector<Key>& keys) { return value_at(keys, frame)[0]; }

Key key(double frame, double value, Interpolation interpolation = linear) { return {frame, {value}, interpolation}; }

std::string reported_at(const std::string& text, int frame) {
  Diagnostics diagnostics("s");
  parse_scene(text, diagnostics, 0, {frame, {}});
  std::ostringstream out;
  diagnostics.print(out);
  return out.str();
}

std::string printed_at(const std::string& text, int frame) {
  Diagnostics diagnostics("s");
  const auto scene = parse_scene(text, diagnostics, 0, {frame, {}});
  return scene ? print_scene(*scene) : reported_at(text, frame);
}

/// The children of a sphere; its radius starts in column 29 of line 2.
std::string with_radius(const std::string& radius) {
  return scene_with_sphere("<center x='0' y='0' z='0'/>" + radius + "<material>clay</material>");
}

}  // namespace

TEST_CASE("a value is held before its first key and after its last one") {
  for (const Interpolation interpolation : {linear, smooth}) {
    const std::vector<Key> keys = {key(2, 5, interpolation), key(4, 9, interpolation)};
    for (const double frame : {-1e9, 1.0, 2.0}) CHECK(at(frame, keys) == 5);
    for (const double frame : {4.0, 4.5, 1e9}) CHECK(at(frame, keys) == 9);
    for (const double frame : {-3.0, 2.0, 77.0}) CHECK(at(frame, {key(2, 5, interpolation)}) == 5);
  }
}

TEST_CASE("linear keys are joined by lines, and met exactly") {
  const std::vector<Key> keys = {key(-1, 0.1), key(1, 0.3), key(1.5, -7)};
  CHECK(at(-1, keys) == 0.1);
  CHECK(at(0, keys) == Approx(0.2));
  CHECK(at(1, keys) == 0.3);
  CHECK(at(1.25, keys) == Approx(-3.35));
  CHECK(at(1.5, keys) == -7);
}

TEST_CASE("between two smooth keys alone a value eases in and out") {
  for (double frame = 0; frame <= 10; frame += 0.5) {
    const double s = frame / 10;
    CHECK(at(frame, {key(0, 2, smooth), key(10, 6, smooth)}) == Approx(2 + 4 * s * s * (3 - 2 * s)));
  }
}

TEST_CASE("a smooth key is passed without a corner, a linear one with") {
  constexpr double step = 1e-6;
  const auto corner = [&](Interpolation interpolation) {
    const std::vector<Key> keys = {key(0, 0), key(2, 1, interpolation), key(3, 5), key(6, 6)};
    const double before = (at(2, keys) - at(2 - step, keys)) / step;
    const double after = (at(2 + step, keys) - at(2, keys)) / step;
    return std::abs(after - before);
  };
  CHECK(corner(smooth) < 1e-4);
  CHECK(corner(linear) == Approx(3.5).epsilon(1e-4));
}

TEST_CASE("the slope at a smooth key is the weighted harmonic mean of its neighbours'") {
  // Slopes 1/2 and 4, lengths 2 and 1: (4 + 5) / (4 / 0.5 + 5 / 4).
  const std::vector<Key> keys = {key(0, 0), key(2, 1, smooth), key(3, 5)};
  CHECK((at(2 + 1e-6, keys) - 1) / 1e-6 == Approx(9 / 9.25).epsilon(1e-4));
}

TEST_CASE("a value never leaves the range of the keys around it") {
  const std::vector<Key> keys = {key(0, 1e-17, smooth),     key(1, 1e17, smooth), key(1.001, 3),
                                 key(5, 3, smooth),         key(6, 2, smooth),    key(7, 100, smooth),
                                 key(7.000002, -1, smooth), key(1e17, 5, smooth)};
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    const double low = std::min(keys[i].components[0], keys[i + 1].components[0]);
    const double high = std::max(keys[i].components[0], keys[i + 1].components[0]);
    for (int step = 0; step <= 100; ++step) {
      const double value = at(keys[i].frame + (keys[i + 1].frame - keys[i].frame) * step / 100, keys);
      CHECK((value >= low && value <= high));
    }
  }
}

TEST_CASE("numbers, vectors and colours can have keys") {
  const std::string text = R"(<raytracer><viewplane><hres>4</hres><vres>3</vres>
    <background><key frame="10" red="1" green="0" blue="0.5"/><key red="0" green="1" blue="0.5" frame="0"/></background>
    </viewplane><camera><eye><key frame="0" x="0" y="0" z="9"/><!-- any --><key frame="4" x="2" y="-4" z="9"/></eye>
    <lookat x="0" y="0" z="0"/><viewdistance>
      <key frame="-2.5" value="1" interpolation="smooth"/><key frame="7.5" value="3" interpolation=" linear "/>
    </viewdistance></camera></raytracer>)";
  const std::string result = printed_at(text, 1);
  for (const char* const part :
       {R"(<background red="0.1" green="0.9" blue="0.5"/>)", R"(<eye x="0.5" y="-1" z="9"/>)"}) {
    INFO(result);
    CHECK(contains(result, part));
  }
  CHECK(contains(printed_at(text, 100), "<viewdistance>3</viewdistance>"));
  CHECK(contains(printed_at(text, -3), "<viewdistance>1</viewdistance>"));
  // Frame 1 if no other is asked for.
  CHECK(print_scene(accepted(text)) == result);
}

TEST_CASE("variables in keys") {
  Diagnostics diagnostics("s");
  const std::string text =
      with_radius("<radius><key frame='$frame' value='$r'/><key frame='$end' value='9'/></radius>");
  const auto scene = parse_scene(text, diagnostics, 0, {3, {{"r", "2"}, {"end", "4"}}});
  REQUIRE(scene);
  CHECK(std::get<ObjectItems<Sphere>>(scene->objects).at(0).parameters.radius == 2);
}

TEST_CASE("keys that make no sense are refused where they stand") {
  const auto check = [](const std::string& radius, const std::string& expected) {
    CHECK(reported_at(with_radius(radius), 1) == "s:2:" + expected + "\n");
  };
  const std::string good = "<key frame='1' value='2'/>";
  check("<radius><key value='2'/></radius>",
        "36: error: missing attribute 'frame' in <key>; write <key frame=\"1\" value=\"2\"/>");
  check("<radius><key frame='1'/></radius>",
        "36: error: missing attribute 'value' in <key>; write <key frame=\"1\" value=\"1\"/>");
  check("<radius><key/></radius>",
        "36: error: missing attributes 'frame' and 'value' in <key>; write <key frame=\"1\" value=\"1\"/>");
  check("<radius><key frme='1' value='2'/></radius>",
        "41: error: unknown attribute 'frme' in <key>; did you mean 'frame'?");
  check("<radius><key frame='1' x='2'/></radius>",
        "51: error: unknown attribute 'x' in <key>; write <key frame=\"1\" value=\"2\"/>");
  check("<radius>" + good + "<key frame='1.0' value='3'/></radius>",
        "62: error: a second key of frame 1 in <radius>; the first one is in line 2");
  check("<radius><key frame='1' value='2' interpolation='cubic'/></radius>",
        "61: error: 'cubic' for interpolation in <key> is neither linear nor smooth; write one of them");
  check("<radius><key frame='nan' value='2'/></radius>",
        "41: error: 'nan' for frame in <key> is not a finite number; write one such as 1.5");
  check("<radius>" + good + "<key frame='2' value='-2'/></radius>",
        "77: error: '-2' for value in <key> must be greater than 0");
  check("<radius>2" + good + "</radius>",
        "36: error: unexpected text '2' in <radius>, which has keys; remove it or them");
  check("<radius value='2'>" + good + "</radius>",
        "36: error: unexpected attribute 'value' in <radius>, which has keys; write it into them, as in "
        "<key frame=\"1\" value=\"2\"/>");
  check("<radius>" + good + "<kez frame='2' value='2'/></radius>",
        "62: error: unexpected element <kez> beside the keys of <radius>; did you mean <key>?");
  check("<radius>" + good + "<sphere/></radius>",
        "62: error: unexpected element <sphere> beside the keys of <radius>; remove it");
  check("<radius><key frame='1' value='2'>3</key></radius>",
        "61: error: unexpected content of <key>; write it as <key frame=\"1\" value=\"2\"/>");
}

TEST_CASE("keys of a vector have its components, and no value stands beside them") {
  const auto check = [](const std::string& center, const std::string& expected) {
    const std::string text = scene_with_sphere(center + "<radius>1</radius><material>clay</material>");
    CHECK(reported_at(text, 1) == "s:2:" + expected + "\n");
  };
  check("<center><key frame='1' value='2'/></center>",
        "24: error: unknown attribute 'value' in <key>; write <key frame=\"1\" x=\"2\" y=\"2\" z=\"2\"/>");
  check("<center x='1' y='1' z='1'><key frame='1' x='1' y='1' z='1'/></center>",
        "9: error: unexpected attribute 'x' in <center>, which has keys; write it into them, as in "
        "<key frame=\"1\" x=\"1\" y=\"1\" z=\"1\"/>\n"
        "s:2:15: error: unexpected attribute 'y' in <center>, which has keys; write it into them, as in "
        "<key frame=\"1\" x=\"1\" y=\"1\" z=\"1\"/>\n"
        "s:2:21: error: unexpected attribute 'z' in <center>, which has keys; write it into them, as in "
        "<key frame=\"1\" x=\"1\" y=\"1\" z=\"1\"/>");
}

TEST_CASE("keys by other names, and turns about a letter, are written as they are here") {
  const auto check = [](const std::string& children, const std::string& expected) {
    CHECK(contains(reported_at(scene_with_sphere(children + "<material>clay</material>"), 1), "error: " + expected));
  };
  const std::string center = "<center x='0' y='0' z='0'/>", radius = "<radius>1</radius>";
  check(center + "<radius><keyframe frame='3' value='2'/></radius>",
        "unexpected element <keyframe> in <radius>; did you mean <key frame=\"3\" value=\"2\"/>?\n");
  check("<center><keyframe frame='3' x='2' y='1' z='0'/></center>" + radius,
        "unexpected element <keyframe> in <center>; did you mean <key frame=\"3\" x=\"2\" y=\"1\" z=\"0\"/>?\n");
  const auto rotate = [&](const std::string& attributes) {
    return center + radius + "<transform><rotate " + attributes + "/></transform>";
  };
  const std::string unknown = "unknown attribute 'axis' in <rotate>; write <rotate ";
  check(rotate("axis='y' angle='30'"), unknown + "x=\"0\" y=\"1\" z=\"0\" angle=\"30\"/>\n");
  check(rotate("axis='X'"), unknown + "x=\"1\" y=\"0\" z=\"0\" angle=\"30\"/>\n");
}

TEST_CASE("the numbers of a textured colour with keys go into the keys") {
  const std::string text = scene_with(
      "<textures><checkers><checker><name>c</name><color1 red='1' green='1' blue='1'/><color2 red='0' green='0' "
      "blue='0'/></checker></checkers></textures><materials><mattes><matte><name>m</name><ka>1</ka><kd>1</kd><cd "
      "red='1' texture='c'><key frame='1' red='1' green='1' blue='1'/></cd></matte></mattes></materials>");
  CHECK(
      contains(reported_at(text, 1), "unexpected attribute 'red' in <cd>, which has keys; write it into them, as in "));
}

TEST_CASE("integers, booleans and names have no keys") {
  for (const char* const element : {"hres", "samples", "shadows", "name"}) {
    const std::string children = std::string("<") + element + "><key frame='1' value='1'/></" + element + ">";
    const std::string text = std::string(element) == "name"
                                 ? with_radius(children + "<radius>1</radius>")
                                 : "<raytracer><viewplane>" + children +
                                       "</viewplane><lights><pointlights><pointlight>" + children +
                                       "</pointlight></pointlights></lights></raytracer>";
    CHECK(contains(reported_at(text, 1),
                   "unexpected element <key> in <" + std::string(element) + ">, which takes a plain value"));
  }
}

TEST_CASE("a direction must not be 0 at the frame at hand") {
  const std::string text = scene_with(
      "<objects><planes><plane><point x='0' y='0' z='0'/><normal><key frame='0' x='0' y='1' z='0'/>"
      "<key frame='2' x='0' y='-1' z='0'/></normal><material>clay</material></plane></planes></objects>");
  CHECK(reported_at(text, 0) == "");
  CHECK(contains(reported_at(text, 1), "<normal> is a direction, so x, y and z must not all be 0"));
  CHECK(contains(reported_at(text, 1), "at frame 1"));
}

TEST_CASE("a colour's keys may be temperatures: between them the temperature changes steadily") {
  const auto lamp = [](const std::string& color, int frame) {
    const std::string text = printed_at(
        "<raytracer><viewplane><hres>4</hres><vres>3</vres>" + color +
            "</viewplane><camera><eye x='0' y='0' z='1'/><lookat x='0' y='0' z='0'/><fov>40</fov></camera></raytracer>",
        frame);
    const std::size_t begin = text.find("<background");
    REQUIRE(begin != std::string::npos);
    return text.substr(begin, text.find("/>", begin) - begin);
  };
  const std::string keys = "<background><key frame='1' kelvin='2000'/><key frame='5' kelvin='6000'/></background>";
  CHECK(lamp(keys, 3) == lamp("<background kelvin='4000'/>", 1));
  CHECK(lamp(keys, 1) == lamp("<background kelvin='2000'/>", 1));
  CHECK(lamp(keys, 3) != lamp(keys, 1));
}

}  // namespace raytrace::test
