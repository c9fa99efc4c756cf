// $name in the values of a scene.
#include "raytrace/description/variables.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>

#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

using Values = std::map<std::string, std::string>;

std::string reported(const std::string& text, const Values& values, int threads = 0) {
  Diagnostics diagnostics("s");
  parse_scene(text, diagnostics, threads, {7, values});
  std::ostringstream out;
  diagnostics.print(out);
  return out.str();
}

std::string printed(const std::string& text, const Values& values) {
  Diagnostics diagnostics("s");
  const auto scene = parse_scene(text, diagnostics, 0, {7, values});
  return scene ? print_scene(*scene) : reported(text, values);
}

std::string replaced(std::string_view text) {
  std::string result;
  const OptionalMessage message = Variables({7, {{"a", "1"}, {"ab", "2"}, {"_A9", "$a"}}}).replace(text, result);
  return message ? *message : result;
}

std::string sphere(const std::string& radius) {
  return scene_with_sphere("<center x='0' y='0' z='0'/><radius>" + radius + "</radius><material>clay</material>");
}

}  // namespace

TEST_CASE("variables in a text are replaced by their values, once") {
  CHECK(replaced("") == "");
  CHECK(replaced("plain") == "plain");
  CHECK(replaced("$a") == "1");
  CHECK(replaced("x$a-$ab.$a") == "x1-2.1");
  CHECK(replaced("$_A9") == "$a");
  CHECK(replaced("$frame$frame") == "77");
  CHECK(replaced("$$a$$$a$$") == "$a$1$");
  CHECK(replaced("$abc") == "uses $abc, which is not set; did you mean $ab?");
  CHECK(replaced("$zzzzzz") == "uses $zzzzzz, which is not set; set it: -D zzzzzz=VALUE");
  for (const char* const text : {"$", "1$", "$ a", "$9", "$-a", "$$$"})
    CHECK(replaced(text) == "has a '$' without a name behind it; write $$ for a dollar");
}

TEST_CASE("braces end a variable's name, and may give it a default") {
  CHECK(replaced("${a}b") == "1b");
  CHECK(replaced("${frame}${a}") == "71");
  CHECK(replaced("${a:-5}") == "1");
  CHECK(replaced("x${z:-5}y") == "x5y");
  CHECK(replaced("${z:-}") == "");
  CHECK(replaced("${z:--1.5e3}") == "-1.5e3");
  CHECK(replaced("${z:-two words}$a") == "two words1");
  CHECK(replaced("${z:-$$5}") == "$5");
  CHECK(replaced("${frame:-3}") == "7");
  CHECK(replaced("$${a}") == "${a}");
  CHECK(replaced("${_A9:-3}") == "$a");
  CHECK(replaced("${abc}") == "uses $abc, which is not set; did you mean $ab?");
  CHECK(replaced("${z:-${a}}") ==
        "has a variable in the default of ${z}; a default is a plain value, with $$ for a dollar");
  for (const char* const text : {"${a", "${", "${z:-5"})
    CHECK(contains(replaced(text), "has a '${' without a '}'; write ${name}"));
  for (const char* const text : {"${}", "${:-1}", "${9}", "${a b}", "${a:=5}", "${a-5}", "${ a}"})
    CHECK(contains(replaced(text), "has a '${' that is no variable; write ${name}, or ${name:-value}"));
}

TEST_CASE("a whole number may have leading zeros, as names of files do") {
  CHECK(replaced("p.${frame:04}.ply") == "p.0007.ply");
  CHECK(replaced("${a:01}${ab:02}${a:012}") == "102000000000001");
  CHECK(replaced("${abc:04}") == "uses $abc, which is not set; did you mean $ab?");
  CHECK(replaced("${_A9:04}") == "has a '${_A9:04}', but '$a' is no whole number");
  std::string result;
  CHECK_FALSE(Variables({-7, {}}).replace("${frame:04} ${frame:01}", result));
  CHECK(result == "-007 -7");
  CHECK_FALSE(Variables({12345, {}}).replace("${frame:04}", result));
  CHECK(result == "12345");
  for (const char* const text : {"${a:4}", "${a:0}", "${a:0x}", "${a:}", "${a:0123}", "${a:04d}"})
    CHECK(contains(replaced(text),
                   "has a '${' that is no variable; write ${name}, or ${name:-value} with a default, or "
                   "${name:04} for four digits"));
}

TEST_CASE("an empty value counts as none where there is a default, as in the shell") {
  std::string result;
  CHECK_FALSE(Variables({1, {{"e", ""}}}).replace("<${e}><${e:-2}>", result));
  CHECK(result == "<><2>");
}

TEST_CASE("a default stands where the variable is not set, and -D overrides it") {
  const std::string text = sphere("${radius:-2}");
  CHECK(contains(printed(text, {}), "<radius>2</radius>"));
  CHECK(contains(printed(text, {{"radius", "3"}}), "<radius>3</radius>"));
  CHECK(reported(text, {{"radius", "0"}}) == "s:2:36: error: '0' in <radius> must be greater than 0\n");
  CHECK(reported(sphere("${radius:-x}"), {}) ==
        "s:2:36: error: 'x' in <radius> is not a number; write one such as 1.5\n");
  CHECK(reported(text, {{"radios", "3"}}) == "s: error: no value of the scene uses $radios; remove -D radios=...\n");
}

TEST_CASE("what a text becomes with the values put in has a limit") {
  const std::string half(Variables::longest_text / 2, '1');
  const Variables variables({7, {{"a", half}}});
  std::string result;
  CHECK_FALSE(variables.replace("$a$a", result));
  CHECK(result.size() == Variables::longest_text);
  CHECK(variables.replace("$a$a${a}", result) ==
        std::string("is longer than 1 MiB with the variables' values put in; shorten them"));
  CHECK(variables.replace("$a${b:-" + half + "}1$$", result).has_value());
  // Millions of them stop at once.
  std::string many;
  for (int i = 0; i < 1000000; ++i) many += "$a";
  CHECK(contains(reported(sphere(many), {{"a", half}}),
                 "in <radius> is longer than 1 MiB with the variables' values put in; shorten them\n"));
}

TEST_CASE("what all texts of a scene become has a limit") {
  const Variables variables({7, {{"a", std::string(Variables::longest_text, '1')}}});
  std::string result;
  for (std::size_t length = 0; length <= Variables::longest_scene; length += Variables::longest_text)
    REQUIRE_FALSE(variables.replace("$a", result));
  const OptionalMessage message = variables.replace("$a", result);
  REQUIRE(message);
  CHECK(contains(*message, "makes the scene longer than 2 GiB"));
}

TEST_CASE("a variable that is not set is reported once") {
  std::string keys;
  for (int i = 0; i < 25; ++i) keys += "<key frame='" + std::to_string(i) + "' value='$size'/>\n";
  CHECK(
      reported(sphere(keys), {}) ==
      "s:2:51: error: '$size' for value in <key> uses $size, which is not set; set it: -D size=VALUE (and at 24 other "
      "places)\n");
  // In the chunks of a large scene, too, however many threads read them; other errors are reported beside it.
  std::string items;
  for (int i = 0; i < 3000; ++i)
    items += "<sphere><center x='0' y='$y' z='0'/><radius>" + std::string(i == 2000 ? "-1" : "$r") +
             "</radius><material>clay</material></sphere>\n";
  const std::string scene = scene_with("<objects><spheres>\n" + items + "</spheres></objects>");
  for (const int threads : {1, 4}) {
    const std::string found = reported(scene, {}, threads);
    INFO(found);
    CHECK(contains(found,
                   "s:3:23: error: '$y' for y in <center> uses $y, which is not set; set it: -D y=VALUE (and at "
                   "2999 other places)\n"));
    CHECK(contains(found, "uses $r, which is not set; set it: -D r=VALUE (and at 2998 other places)\n"));
    CHECK(contains(found, "s:2003:"));
    CHECK(std::count(found.begin(), found.end(), '\n') == 3);
  }
}

TEST_CASE("names of variables") {
  for (const char* const name : {"a", "_", "Z9", "a_b"}) CHECK(is_variable_name(name));
  for (const char* const name : {"", "9", "a-b", "a ", "$a", "\xc3\xa4"}) CHECK_FALSE(is_variable_name(name));
}

TEST_CASE("a variable can stand in a value of every type") {
  const std::string text = R"(<raytracer><viewplane><hres>$w</hres><vres>1$w</vres></viewplane>
    <camera><eye x="0" y="-$y" z="9"/><lookat x="0" y="0" z="0"/><viewdistance>$frame</viewdistance></camera>
    <lights><pointlights><pointlight><location x="0" y="1" z="$frame"/><color red="$y" green="1" blue="1"/>
      <shadows>$lit</shadows></pointlight></pointlights></lights>
    <materials><mattes><matte><name>my $m</name><ka>0</ka><kd>1</kd><cd red="1" green="1" blue="1"/></matte></mattes>
    </materials><objects><spheres><sphere><name>$$5</name><center x="0" y="0" z="0"/><radius> $y </radius>
      <material>my $m</material></sphere></spheres></objects></raytracer>)";
  const std::string result = printed(text, {{"w", "4"}, {"y", "0.5"}, {"m", "clay & loam"}, {"lit", "false"}});
  for (const char* const part :
       {"<hres>4</hres>", "<vres>14</vres>", "<viewdistance>7</viewdistance>", "z=\"7\"", "red=\"0.5\"",
        "<shadows>false</shadows>", "<name>my clay &amp; loam</name>", "<name>$$5</name>", "<radius>0.5</radius>",
        "<material>my clay &amp; loam</material>"}) {
    INFO(result);
    CHECK(contains(result, part));
  }
}

TEST_CASE("a variable that is not set is an error where it stands") {
  CHECK(reported(sphere("$radius"), {}) ==
        "s:2:36: error: '$radius' in <radius> uses $radius, which is not set; set it: -D radius=VALUE\n");
  CHECK(reported(sphere("1$$"), {}) == "s:2:36: error: '1$' in <radius> is not a number; write one such as 1.5\n");
  // What was probably meant is not reported as unused, too.
  CHECK(reported(sphere("$radius"), {{"raduis", "2"}}) ==
        "s:2:36: error: '$radius' in <radius> uses $radius, which is not set; did you mean $raduis?\n");
  CHECK(contains(
      reported(scene_with_sphere("<center x='0' y='$y' z='0'/><radius>1</radius><material>clay</material>"), {}),
      "s:2:15: error: '$y' for y in <center> uses $y, which is not set"));
}

TEST_CASE("the value of a variable is checked as if it stood in the scene") {
  CHECK(reported(sphere("$r"), {{"r", "-1"}}) == "s:2:36: error: '-1' in <radius> must be greater than 0\n");
  CHECK(contains(reported(sphere("$r"), {{"r", "<"}}), "'<' in <radius> is not a number"));
  const auto with_material = [](const std::string& name) {
    return scene_with_sphere("<center x='0' y='0' z='0'/><radius>1</radius><material>" + name + "</material>");
  };
  CHECK(reported(with_material("$m"), {{"m", "clay"}}) == "");
  CHECK(reported(with_material("$m"), {}) ==
        "s:2:56: error: '$m' in <material> uses $m, which is not set; set it: -D m=VALUE\n");
  CHECK(contains(reported(with_material("$m"), {{"m", "cley"}}), "unknown material 'cley'"));
  CHECK(contains(reported(with_material("$m"), {{"m", ""}}), "'$m' in <material> is empty"));
}

TEST_CASE("a variable that nothing uses is an error") {
  CHECK(reported(sphere("1"), {{"radius", "2"}}) ==
        "s: error: no value of the scene uses $radius; remove -D radius=...\n");
  CHECK(reported(sphere("1$$radius"), {{"radius", "2"}}) ==
        "s:2:36: error: '1$radius' in <radius> is not a number; write one such as 1.5\n");
  CHECK(reported(sphere("$radius"), {{"radius", "2"}}) == "");
}

TEST_CASE("variables in the chunks of a large scene") {
  const auto scene_of_spheres = [](const std::string& prefix) {
    std::string items;
    for (int i = 0; i < 3000; ++i) {
      const std::string number = std::to_string(i);
      items += "<sphere><name>" + prefix + number + "</name><center x='" + number +
               "' y='$y' z='0'/><radius>1</radius><material>$m</material></sphere>\n";
    }
    return scene_with("<objects><spheres>\n" + items + "</spheres></objects>");
  };
  // Digits belong to the name.
  CHECK(contains(reported(scene_of_spheres("$a"), {{"a", "q"}, {"y", "3"}, {"m", "clay"}}, 4),
                 "2900 more errors not shown"));
  const Values values = {{"a", "q"}, {"y", "3"}, {"m", "clay"}};
  Diagnostics diagnostics("s");
  for (const int threads : {1, 4}) {
    const auto scene = parse_scene(scene_of_spheres("p$a-"), diagnostics, threads, {1, values});
    REQUIRE(scene);
    const auto& spheres = std::get<ObjectItems<Sphere>>(scene->objects);
    REQUIRE(spheres.size() == 3000);
    CHECK(spheres.back().name == "pq-2999");
    CHECK(spheres.back().parameters.center.y == 3);
  }
}

}  // namespace raytrace::test
