#include <array>
#include <string>
#include <vector>

#include "raytrace/text/message.h"
#include "support/catch.h"

namespace raytrace::test {
namespace {

constexpr std::array<std::string_view, 5> names = {"radius", "center", "material", "name", "hres"};

}  // namespace

TEST_CASE("the distance counts letters inserted, removed, replaced and swapped") {
  CHECK(edit_distance("radius", "radius", 3) == 0);
  CHECK(edit_distance("raduis", "radius", 3) == 1);
  CHECK(edit_distance("radus", "radius", 3) == 1);
  CHECK(edit_distance("raddius", "radius", 3) == 1);
  CHECK(edit_distance("radios", "radius", 3) == 1);
  CHECK(edit_distance("RADIUS", "radius", 3) == 0);
  CHECK(edit_distance("abcd", "badc", 3) == 2);
  CHECK(edit_distance("", "abc", 5) == 3);
  CHECK(edit_distance("ca", "abc", 5) == 3);  // no letter is changed twice: this is not the unrestricted distance
  CHECK(edit_distance("kitten", "sitting", 3) == 3);
  CHECK(edit_distance("kitten", "sitting", 2) == 3);
  CHECK(edit_distance("abcdefgh", "ijklmnop", 2) == 3);
}

TEST_CASE("the nearest name is the one that was meant") {
  CHECK(nearest_name("raduis", names) == "radius");
  CHECK(nearest_name("centre", names) == "center");
  CHECK(nearest_name("Material", names) == "material");
  CHECK(nearest_name("materials", names) == "material");
  CHECK(nearest_name("hrez", names) == "hres");
  CHECK(nearest_name("transparency", names) == "");
  CHECK(nearest_name("", names) == "");
  CHECK(nearest_name("x", names) == "");
  CHECK(nearest_name("radius", {}) == "");
}

TEST_CASE("of equally near names the first is offered") {
  const std::vector<std::string_view> equals = {"spheres", "sphered"};
  CHECK(nearest_name("spherez", equals) == "spheres");
}

TEST_CASE("names of any length and number are answered") {
  const std::string megabyte(1 << 20, 'a');
  CHECK(nearest_name(megabyte, names) == "");
  const std::vector<std::string_view> long_names(1000, megabyte);
  CHECK(nearest_name("radius", long_names) == "");
  std::vector<std::string_view> many(1'000'000, "material");
  many.front() = "materiel";
  CHECK(nearest_name("materials", many) == "material");
}

}  // namespace raytrace::test
