// Strands of hair from files.
#include <functional>
#include <limits>
#include <optional>

#include "import/support.h"
#include "raytrace/import/read_strands.h"
#include "support/contains.h"

namespace raytrace::test {

namespace {

struct ReadStrands {
  std::optional<Strands> strands;
  std::string messages;
};

ReadStrands read(const std::string& name, const std::string& bytes, const MeshReadSettings& settings = {}) {
  const TemporaryFolder folder;
  write_text(folder.file(name), bytes);
  Diagnostics diagnostics(folder.file(name));
  ReadStrands result;
  result.strands = read_strands(folder.file(name), settings, diagnostics);
  result.messages = printed(diagnostics, folder.path().string());
  return result;
}

using Floats = std::vector<float>;

/// A .hair file of two strands, of 2 and 3 points.
struct Hair {
  std::uint32_t strands = 2, points = 5, arrays = 1 | 2 | 4 | 16, default_segments = 0;
  float default_thickness = 0;
  std::vector<std::uint16_t> segments{1, 2};
  Floats positions{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0}, thicknesses{2, 1, 2, 1, 0}, transparencies,
      colors{1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0.5F};

  std::string bytes() const {
    std::string result = "HAIR";
    const auto add = [&](const auto& value) { result.append(reinterpret_cast<const char*>(&value), sizeof value); };
    const auto add_all = [&](const auto& values) {
      for (const auto& value : values) add(value);
    };
    for (const std::uint32_t number : {strands, points, arrays, default_segments}) add(number);
    for (const float number : {default_thickness, 0.0F, 1.0F, 1.0F, 1.0F}) add(number);
    result.resize(128);
    add_all(segments);
    add_all(positions);
    add_all(thicknesses);
    add_all(transparencies);
    add_all(colors);
    return result;
  }
};

std::string messages_of(const std::function<void(Hair&)>& change) {
  Hair hair;
  change(hair);
  return read("a.hair", hair.bytes()).messages;
}

}  // namespace

TEST_CASE("a .hair file has the strands of its arrays, thicknesses being diameters") {
  const auto [strands, messages] = read("a.hair", Hair().bytes());
  REQUIRE(strands);
  CHECK(messages == "");
  CHECK(strands->ends == std::vector<std::uint32_t>{2, 5});
  CHECK(values(strands->positions) == Hair().positions);
  CHECK(values(strands->radii) == Floats{1, 0.5F, 1, 0.5F, 0});
  CHECK(values(strands->colors) == Hair().colors);

  Hair evenly;
  evenly.arrays = 2;
  evenly.strands = 2;
  evenly.points = 4;
  evenly.default_segments = 1;
  evenly.default_thickness = 3;
  evenly.segments = {};
  evenly.thicknesses = evenly.colors = {};
  evenly.positions.resize(12);
  const auto other = read("A.HAIR", evenly.bytes(), {.origin = {1, 0, 0}});
  REQUIRE(other.strands);
  CHECK(other.strands->ends == std::vector<std::uint32_t>{2, 4});
  CHECK(values(other.strands->radii) == Floats{1.5F, 1.5F, 1.5F, 1.5F});
  CHECK(other.strands->colors.empty());
  CHECK(other.strands->positions[0] == -1);
  CHECK(other.strands->positions[6] == 0);
  CHECK(other.strands->origin.x == 1);

  Hair bare = evenly;
  bare.default_thickness = 0;
  CHECK(read("a.hair", bare.bytes()).strands->radii.empty());
}

TEST_CASE("a .hair file whose numbers lie is refused before memory is taken for them") {
  CHECK(contains(messages_of([](Hair& h) { h.strands = 0; }), "a.hair: error: has no strands"));
  CHECK(contains(messages_of([](Hair& h) { h.strands = 1000000000; }), "ends too early: its 1000000000 strands"));
  CHECK(contains(messages_of([](Hair& h) { h.points = 0xffffffff; }), "ends too early"));
  CHECK(contains(messages_of([](Hair& h) { h.colors.pop_back(); }), "take 272 bytes, and it has 268"));
  CHECK(contains(messages_of([](Hair& h) { h.segments[0] = 7; }), "and its strands take more"));
  CHECK(contains(messages_of([](Hair& h) { h.segments[0] = 0; }), "and its strands take 4"));
  CHECK(contains(messages_of([](Hair& h) { h.arrays = 1; }), "has no array of points"));
  CHECK(contains(messages_of([](Hair& h) {
                   h.arrays = 2;
                   h.default_segments = 0xffffffff;
                 }),
                 "and its strands take more"));
  CHECK(contains(read("a.hair", "HAIR").messages, "is no .hair file"));
  CHECK(contains(read("a.hair", "").messages, "is empty"));
  CHECK(contains(read("a.hair.gz", Hair().bytes()).messages, "the compressed data is damaged"));
}

TEST_CASE("strands that cannot be rendered are left out, and counted in one warning") {
  const float infinity = std::numeric_limits<float>::infinity();
  Hair hair;
  hair.positions[4] = infinity;
  const auto one = read("a.hair", hair.bytes());
  REQUIRE(one.strands);
  CHECK(contains(one.messages, "a.hair: warning: 1 strand is left out"));
  CHECK(one.strands->ends == std::vector<std::uint32_t>{3});
  CHECK(one.strands->positions[0] == 1);
  CHECK(one.strands->radii.size() == 3);
  CHECK(contains(messages_of([](Hair& h) { h.thicknesses[1] = -1; }), "1 strand is left out"));
  CHECK(contains(messages_of([](Hair& h) { h.thicknesses[1] = std::nanf(""); }), "1 strand is left out"));
  CHECK(contains(messages_of([](Hair& h) { h.segments = {0, 3}; }), "1 strand is left out"));
  CHECK(contains(messages_of([&](Hair& h) { h.positions[0] = h.positions[6] = infinity; }),
                 "error: has no strands that can be rendered"));
  CHECK(contains(messages_of([](Hair& h) {
                   h.arrays |= 8;
                   h.transparencies.resize(5);
                 }),
                 "the transparencies of its points are left out"));
}

TEST_CASE("text has a point a line, and empty lines between strands") {
  const auto [strands, messages] = read("a.txt", "0 0 0 1\n0 1 0 0.5\n\n\n 1 0 0 2 \r\n1 1 0 2\r\n\r\n1 5 5 1\n\n");
  REQUIRE(strands);
  CHECK(contains(messages, "1 strand is left out: of a single point"));
  CHECK(strands->ends == std::vector<std::uint32_t>{2, 4});
  CHECK(values(strands->positions) == Floats{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0});
  CHECK(values(strands->radii) == Floats{1, 0.5F, 2, 2});
  const auto bare = read("a.curves", "0 0 0\n0 1e400 0\n\n0 0 0\n0 1 0");
  REQUIRE(bare.strands);
  CHECK(bare.strands->radii.empty());
  CHECK(bare.strands->ends == std::vector<std::uint32_t>{2});
  CHECK(contains(read("a.txt", "0 0 0 1\n0 1 0\n").messages, "a.txt:2: error: is no point of a strand"));
  CHECK(contains(read("a.txt", "0 0 0 x\n").messages, "a.txt:1: error: is no point of a strand"));
  CHECK(contains(read("a.txt", "1 2\n").messages, "a.txt:1: error: is no point of a strand"));
  CHECK(contains(read("a.txt", "\n\n").messages, "a.txt: error: has no strands"));
  CHECK(contains(read("a.txt", "0 0 0 -1\n1 0 0 -1\n").messages, "has no strands that can be rendered"));
}

}  // namespace raytrace::test
