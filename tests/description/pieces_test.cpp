// Scenes so large that they are read in chunks, by several threads, with the same result.
#include <algorithm>
#include <chrono>
#include <sstream>
#include <string>
#include <vector>

#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/xml_scanner.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

constexpr int sphere_count = 4000;

std::string numbered_sphere(int i, const std::string& material = "clay") {
  const std::string number = std::to_string(i);
  return "  <sphere>\n    <name>sphere-" + number + "</name>\n    <center x=\"" + number +
         "\" y=\"0\" z=\"0\"/>\n    <radius>1</radius>\n    <material>" + material + "</material>\n  </sphere>\n";
}

/// Some 500 kB. at(i): what stands for sphere i.
template <class At>
std::string large_scene(At&& at) {
  std::string items;
  for (int i = 0; i < sphere_count; ++i) items += at(i);
  return scene_with("<objects><spheres>\n" + items + "</spheres><disks/></objects>");
}

std::string large_scene() {
  return large_scene([](int i) { return numbered_sphere(i); });
}

std::string reported(const std::string& text, int threads) {
  Diagnostics diagnostics("s");
  parse_scene(text, diagnostics, threads);
  std::ostringstream out;
  diagnostics.print(out);
  return out.str();
}

std::string line_and_column(const std::string& text, const std::string& part) {
  REQUIRE(text.find(part) == text.rfind(part));
  const SourceLocation location = locate(text, text.find(part));
  return "s:" + std::to_string(location.line) + ":" + std::to_string(location.column);
}

std::string without_line_ends(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

TEST_CASE("groups are cut into chunks of whole items") {
  const std::string text = large_scene();
  std::vector<TextChunk> chunks;
  const std::string_view groups[] = {"spheres", "disks", "mattes"};
  REQUIRE_FALSE(find_xml_error(text, groups, chunks, 1));
  REQUIRE(chunks.size() > 5);

  CHECK(text.compare(chunks[0].begin, 7, "<matte>") == 0);
  CHECK(text.compare(chunks[0].end, 9, "</mattes>") == 0);
  CHECK(chunks[0].items == 1);

  std::size_t items = 0;
  for (std::size_t i = 1; i < chunks.size(); ++i) {
    items += chunks[i].items;
    CHECK(chunks[i].group == text.find("<spheres>"));
    CHECK(chunks[i].begin == (i == 1 ? text.find("<sphere>") : chunks[i - 1].end));
    CHECK(text.compare(chunks[i].begin, 8, "<sphere>") == 0);
  }
  CHECK(chunks.back().end == text.find("</spheres>"));
  CHECK(items == sphere_count);
}

TEST_CASE("a scene in chunks is read as it stands, by any number of threads") {
  const std::string text = large_scene();
  Diagnostics diagnostics("s");
  const auto scene = parse_scene(text, diagnostics, 1);
  REQUIRE(scene);
  const auto& spheres = std::get<ObjectItems<Sphere>>(scene->objects);
  REQUIRE(spheres.size() == sphere_count);
  for (int i = 0; i < sphere_count; ++i) {
    const ObjectItem<Sphere>& item = spheres[static_cast<std::size_t>(i)];
    REQUIRE(item.name == "sphere-" + std::to_string(i));
    REQUIRE(item.parameters.center.x == i);
    REQUIRE(item.line == static_cast<std::uint32_t>(3 + 6 * i));
  }
  for (const int threads : {0, 2, 5}) {
    CHECK(print_scene(*parse_scene(text, diagnostics, threads)) == print_scene(*scene));
  }
}

TEST_CASE("errors in chunks have their lines and columns") {
  const std::string text = large_scene([](int i) {
    if (i == 0) return "before" + numbered_sphere(i, "one");
    if (i == 1500) return numbered_sphere(i, "two");
    if (i == 2500) return "<!-- \n --> <spehre/>" + numbered_sphere(i);
    if (i == 3500)
      return numbered_sphere(i) + "<sphere><center x='a>b'\ty='0' z='0'/><radius>1</radius>" +
             "<material>clay</material></sphere>";
    if (i == 3999) return numbered_sphere(i) + "\n behind ";
    return numbered_sphere(i);
  });
  for (const std::string& in : {text, without_line_ends(text)}) {
    const std::string expected =
        line_and_column(in, "before") + ": error: unexpected text 'before' in <spheres>, which takes only elements\n" +
        line_and_column(in, "one</material>") +
        ": error: unknown material 'one' in <sphere>; add one of that name to <materials>\n" +
        line_and_column(in, "two</material>") +
        ": error: unknown material 'two' in <sphere>; add one of that name to <materials>\n" +
        line_and_column(in, "<spehre/>") + ": error: unknown element <spehre> in <spheres>; did you mean <sphere>?\n" +
        line_and_column(in, "x='a>b'") + ": error: 'a>b' for x in <center> is not a number; write one such as 1.5\n" +
        line_and_column(in, "behind") + ": error: unexpected text 'behind' in <spheres>, which takes only elements\n";
    for (const int threads : {1, 4}) CHECK(reported(in, threads) == expected);
  }
}

TEST_CASE("a name that is taken in another chunk is reported where it stands") {
  const std::string text = large_scene([](int i) { return numbered_sphere(i == 3500 ? 17 : i); });
  const std::size_t at = text.rfind("sphere-17</name>");
  const SourceLocation name = locate(text, at);
  CHECK(reported(text, 4) == "s:" + std::to_string(name.line) + ":" + std::to_string(name.column) +
                                 ": error: the object name 'sphere-17' is taken by the <sphere> in line " +
                                 std::to_string(3 + 6 * 17) + "; choose another\n");
}

TEST_CASE("which errors are shown does not depend on the threads") {
  const std::string text = large_scene([](int i) {
    const std::string shadows = "<sphere><radius>-1</radius><raduis>1</raduis></sphere>";
    return i % 25 == 24 ? shadows : numbered_sphere(i, i % 31 == 7 ? "cley" : "clay");
  });
  const std::string alone = reported(text, 1);
  CHECK(contains(alone, "more errors not shown"));
  CHECK(reported(text, 4) == alone);
  CHECK(reported(text, 0) == alone);
}

TEST_CASE("what follows a group in chunks keeps its lines and columns") {
  std::string text = large_scene();
  text.replace(text.find("<disks/>"), 8, "<discs/>\n <disks>x</disks>");
  CHECK(reported(text) == line_and_column(text, "<discs/>") +
                              ": error: unknown element <discs> in <objects>; did you mean <disks>?\n" +
                              line_and_column(text, "x</disks>") +
                              ": error: unexpected text 'x' in <disks>, which takes only elements\n");
  const std::string flat = without_line_ends(text);
  CHECK(contains(reported(flat), line_and_column(flat, "<discs/>") + ": error:"));
}

TEST_CASE("items have the lines and columns of their elements") {
  const std::string text = large_scene();
  for (const std::string& in :
       {text, without_line_ends(text), std::string(byte_order_mark) + without_line_ends(text)}) {
    Diagnostics diagnostics("s");
    const auto scene = parse_scene(in, diagnostics, 2);
    REQUIRE(scene);
    LineMark mark = first_mark(in);
    for (const auto& item : std::get<ObjectItems<Sphere>>(scene->objects)) {
      const std::size_t next = in.find("<sphere>", mark.offset + 1);
      mark.pass(std::string_view(in).substr(mark.offset, next - mark.offset));
      REQUIRE(item.line == mark.location().line);
      REQUIRE(item.column == mark.location().column);
    }
  }
}

TEST_CASE("a scene in one line is read in about the time of one in many") {
  const auto seconds_of = [](const char* line_end) {
    std::string text = scene_with("");
    std::string instances = "<objects><instances>";
    const auto append = [&](const std::string& more) { instances += more + line_end; };
    for (int i = 0; i < 15000; ++i)
      append("<instance><group>g</group><transform><translate x='" + std::to_string(i) +
             "' y='0' z='0'/></transform></instance>");
    append("</instances></objects><groups>");
    for (int i = 0; i < 3000; ++i)
      append("<group><name>" + (i == 0 ? std::string("g") : "g" + std::to_string(i)) +
             "</name><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>clay</material>"
             "</sphere></spheres></objects></group>");
    text.replace(text.rfind("</raytracer>"), 0, instances + "</groups>");
    Diagnostics diagnostics("s");
    const auto start = std::chrono::steady_clock::now();
    REQUIRE(parse_scene(text, diagnostics, 1));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  // Where each column is counted from the start of the line, it takes fifty times as long.
  CHECK(seconds_of("") < 8 * seconds_of("\n") + 0.2);
}

}  // namespace raytrace::test
