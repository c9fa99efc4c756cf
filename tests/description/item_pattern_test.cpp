// Items that are written like the ones before them are read without being parsed, with the same result.
#include "raytrace/description/item_pattern.h"

#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "raytrace/description/read_fields.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/xml/document.h"
#include "raytrace/xml/scene_text.h"
#include "reported.h"
#include "support/catch.h"

namespace raytrace::test {
namespace {

/// What comes of a text.
struct ReadText {
  std::string reported, scene;
  std::vector<std::uint32_t> lines;  ///< of the objects
};

ReadText read_text(const std::string& text) {
  Diagnostics diagnostics("s");
  const auto scene = parse_scene(text, diagnostics, 2, {7, {{"size", "2"}}});
  std::ostringstream out;
  diagnostics.print(out);
  ReadText result{out.str(), {}, {}};
  if (!scene) return result;
  result.scene = print_scene(*scene);
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    for (const auto& item : std::get<ObjectItems<Shape>>(scene->objects)) result.lines.push_back(item.line);
  });
  return result;
}

/// A group of which each item ends with a comment, or none: a comment has no part in a pattern. Comments stand where
/// nothing that a message locates comes after them in their line.
struct AlikeGroup {
  std::string section, group, item;
  std::vector<std::string> contents;

  std::string scene(bool comments) const {
    std::string text = "<" + section + "><" + group + ">\n";
    for (const std::string& content : contents)
      text += "<" + item + ">" + content + (comments ? "<!-- -->" : "") + "</" + item + ">\n\n";
    // A variable that is set must be used.
    return scene_with(text + "</" + group + "></" + section + "><lights><ambientlight><scaleradiance>$size" +
                      "</scaleradiance></ambientlight></lights>");
  }
};

const std::string clay_end = "<material>clay</material>";

std::string numbered_sphere(int number, const std::string& rest = clay_end) {
  const std::string n = std::to_string(number);
  return "<name>s" + n + "</name>\n <center x=\"" + n + ".25\" y=\"-" + n + "e-2\" z=\"+1\"/><radius>0.5" + n +
         "</radius>" + rest;
}

/// Each of them alone among items that are alike.
void check_among(const std::string& section, const std::string& group, const std::string& item,
                 const std::vector<std::string>& others, const std::vector<std::string>& odd_ones) {
  for (const std::string& odd : odd_ones)
    for (const std::size_t index : {std::size_t{0}, std::size_t{1}, others.size() / 2, others.size()}) {
      AlikeGroup mixed{section, group, item, others};
      mixed.contents.insert(mixed.contents.begin() + static_cast<std::ptrdiff_t>(index), odd);
      INFO(odd << " at index " << index);
      const ReadText alike = read_text(mixed.scene(false)), parsed = read_text(mixed.scene(true));
      CHECK(alike.reported == parsed.reported);
      CHECK(alike.scene == parsed.scene);
      CHECK(alike.lines == parsed.lines);
    }
}

std::vector<std::string> numbered_spheres(int count) {
  std::vector<std::string> items;
  for (int i = 0; i < count; ++i) items.push_back(numbered_sphere(i));
  return items;
}

}  // namespace

TEST_CASE("a sphere written in another way among others that are alike is read as it stands") {
  const std::string center = "<center x=\"1\" y=\"2\" z=\"3\"/>";
  check_among("objects", "spheres", "sphere", numbered_spheres(20),
              {
                  numbered_sphere(99),
                  center + "<radius>1</radius>" + clay_end,
                  "<name>a</name>\n <center z=\"1\" y=\"2\" x=\"3\"/><radius>1</radius>" + clay_end,
                  "<name>a</name>\n <center x='1' y='2' z='3'/><radius>1</radius>" + clay_end,
                  "<name>a</name>\n <center x=\"1\"  y=\"2\" z=\"3\" /><radius> 1\n</radius>" + clay_end,
                  "<name>a</name>\n <center x=\" 1\" y=\"2 \" z=\"3\"/><radius>1 </radius>" + clay_end,
                  "<name>a b</name>\n" + center + "<radius>1</radius><material> clay </material>",
                  "<name>a  b</name>\n " + center + "<radius>1</radius>" + clay_end,
                  "<name>\xc3\xa4 &amp; &#65;]</name>\n " + center + "<radius>1</radius>" + clay_end,
                  "<name>a > b</name>\n " + center + "<radius>1</radius>" + clay_end,
                  "<name><![CDATA[a]]></name>\n " + center + "<radius>1</radius>" + clay_end,
                  "<name></name>\n " + center + "<radius>1</radius>" + clay_end,
                  "<name>a\nb</name>\n " + center + "<radius>1</radius>" + clay_end,
                  "<name>s3</name>\n " + center + "<radius>1</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>$size</radius>" + clay_end,
                  "<name>a$frame</name>\n " + center + "<radius>1</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>$sice</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>-1</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>0</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>1,5</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>1e999</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>nan</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>1 2</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius/>" + clay_end,
                  "<name>a</name>\n " + center + "<radius a=\"1\">1</radius>" + clay_end,
                  "<name>a</name>\n <center x=\"\" y=\"2\" z=\"3\"/><radius>1</radius>" + clay_end,
                  "<name>a</name>\n <center x=\"1\" y=\"2\" z=\"3\" w=\"4\"/><radius>1</radius>" + clay_end,
                  "<name>a</name>\n <center x=\"1\" y=\"2\"/><radius>1</radius>" + clay_end,
                  "<name>a</name>\n <center x=\"1\" y=\"2\" z=\"3\">1</center><radius>1</radius>" + clay_end,
                  "<name>a</name>\n " + center + "<radius>1</radius><material>cley</material>",
                  "<name>a</name>\n " + center + "<radius>1</radius>",
                  "<name>a</name>\n " + center + "<radius>1</radius>" + clay_end + clay_end,
                  "<name>a</name>\n " + center + "<radius>1</radius>" + clay_end + "<raduis>1</raduis>",
                  "<name>a</name>\n " + center + "<radius>1</radius>" + clay_end + "text",
                  "<name>a</name>\n " + center +
                      "<radius><key frame=\"1\" value=\"1\"/><key frame=\"9\" value=\"5\"/></radius>" + clay_end,
                  "",
              });
}

TEST_CASE("other items than spheres are read alike, with their own conditions") {
  const auto repeated = [](const std::string& before, const std::string& after) {
    std::vector<std::string> items;
    for (int i = 1; i < 12; ++i) items.push_back(before + std::to_string(i) + after);
    return items;
  };
  check_among("objects", "planes", "plane",
              repeated("<point x=\"0\" y=\"0\" z=\"0\"/><normal x=\"0\" y=\"", "\" z=\"0\"/>" + clay_end),
              {"<point x=\"0\" y=\"0\" z=\"0\"/><normal x=\"0\" y=\"0\" z=\"0\"/>" + clay_end,
               "<point x=\"0\" y=\"0\" z=\"0\"/><normal x=\"0\" y=\"1e-30\" z=\"0\"/>" + clay_end,
               "<point x=\"0\" y=\"0\" z=\"0\"/><normal x=\"0\" y=\"1e18\" z=\"0\"/>" + clay_end});
  const std::string corners = "<vertexposition1 x=\"0\" y=\"0\" z=\"0\"/><vertexposition2 x=\"1\" y=\"0\" z=\"0\"/>";
  check_among("objects", "triangles", "triangle",
              repeated(corners + "<vertexposition3 x=\"0\" y=\"", "\" z=\"0\"/>" + clay_end),
              {corners + "<vertexposition3 x=\"0\" y=\"0\" z=\"0\"/>" + clay_end});  // a warning
  check_among(
      "lights", "pointlights", "pointlight",
      repeated("<location x=\"0\" y=\"",
               "\" z=\"0\"/><color red=\"1\" green=\"0.5\" blue=\"0\"/><shadows>true</shadows>"),
      {"<location x=\"0\" y=\"1\" z=\"0\"/><color red=\"1\" green=\"0.5\" blue=\"0\"/><shadows>0</shadows>",
       "<location x=\"0\" y=\"1\" z=\"0\"/><color red=\"1\" green=\"0.5\" blue=\"0\"/><shadows>>true</shadows>",
       "<location x=\"0\" y=\"1\" z=\"0\"/><color red=\"1\" green=\"0.5\" blue=\"0\"/><shadows>yes</shadows>",
       "<location x=\"0\" y=\"1\" z=\"0\"/><color red=\"1\" green=\"0.5\" blue=\"a\"/><shadows>true</shadows>"});
  check_among("materials", "mattes", "matte",
              repeated("<name>m", "</name><ka>0</ka><kd>1</kd><cd red=\"1\" green=\"1\" blue=\"1\"/>"),
              {"<name>m5</name><ka>0</ka><kd>1</kd><cd red=\"1\" green=\"1\" blue=\"1\"/>",
               "<name>a</name><ka>-1</ka><kd>1</kd><cd red=\"1\" green=\"1\" blue=\"1\"/>"});
}

TEST_CASE("items that change their pattern again and again are read as they stand") {
  AlikeGroup mixed{"objects", "spheres", "sphere", {}};
  for (int i = 0; i < 300; ++i) {
    const std::string n = std::to_string(i);
    const bool is_named = i % 2 == 0 || i > 250;
    mixed.contents.push_back((is_named ? "<name>s" + n + "</name>" : "") + (i % 3 == 0 ? clay_end : "") +
                             "<center x=\"" + n + "\" y=\"0\" z=\"0\"/>" + (i % 5 == 0 ? " " : "") +
                             "<radius>1</radius>" + (i % 3 == 0 ? "" : clay_end));
  }
  const ReadText alike = read_text(mixed.scene(false)), parsed = read_text(mixed.scene(true));
  CHECK(alike.reported == "");
  CHECK(alike.scene == parsed.scene);
  CHECK(alike.lines == parsed.lines);
}

TEST_CASE("a pattern reads what is alike, and nothing else") {
  const std::string first = "<sphere><center x='1' y='2' z='3'/>\n<radius>4</radius></sphere>";
  const std::string text = "<raytracer><objects><spheres>" + first + "</spheres></objects></raytracer>";
  Diagnostics diagnostics("s");
  const SceneText source{TextBuffer(text), group_elements(), 1, diagnostics};
  Document document(source);
  document.parse_items(source.chunk(0), diagnostics);

  FieldsReader fields(element_type<Sphere>());
  Sphere::Parameters parameters;
  const auto targets = [&] { return fields.targets(&parameters, {}); };
  const auto pattern = ItemPattern::of(first, document.root().first_child().element(), fields.infos(), targets());
  REQUIRE(pattern);
  CHECK(pattern->line_ends() == 1);

  const auto length = [&](const std::string& item) {
    parameters = {};
    return pattern->read(item, targets());
  };
  CHECK(length(first) == first.size());
  const std::string other = "<sphere><center x='-1.5' y='0' z='1e3'/>\n<radius>0.25</radius></sphere>";
  CHECK(length(other + " <sphere>") == other.size());
  CHECK(parameters.center.x == -1.5);
  CHECK(parameters.center.y == 0);
  CHECK(parameters.center.z == 1000);
  CHECK(parameters.radius == 0.25);
  CHECK(length("<sphere><center x='1' y='2' z='3'/>\n<radius>-4</radius></sphere>") == 0);
  CHECK(length("<sphere><center x='1' y='2' z='3'/>\n<radius>4</radius> </sphere>") == 0);
  CHECK(length("<sphere><center x='1' y='2' z='$z'/>\n<radius>4</radius></sphere>") == 0);
  CHECK(length("<sphere><center y='1' x='2' z='3'/>\n<radius>4</radius></sphere>") == 0);
  CHECK(length(first.substr(0, first.size() - 1)) == 0);
}

}  // namespace raytrace::test
