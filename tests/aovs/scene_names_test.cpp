#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/aovs/cryptomatte.h"
#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

const std::string parts = R"(
  <lights/>
  <materials>
    <phongs><phong><name>shiny</name><ka>0</ka><kd>0</kd><ks>0</ks><cd red="0" green="0" blue="0"/>
      <cs red="0" green="0" blue="0"/></phong></phongs>
    <mattes><matte><name>dull</name><ka>0</ka><kd>0</kd><cd red="0" green="0" blue="0"/></matte></mattes>
  </materials>
  <objects>
    <spheres>
      <sphere><center x="0" y="1" z="0"/><radius>1</radius><material>shiny</material></sphere>
      <sphere><name>the "big" one</name><center x="0" y="1" z="0"/><radius>1</radius><material>dull</material></sphere>
      <sphere><center x="0" y="1" z="0"/><radius>1</radius><material>shiny</material></sphere>
    </spheres>
    <planes><plane><point x="0" y="0" z="0"/><normal x="0" y="1" z="0"/><material>dull</material></plane></planes>
  </objects>)";

/// Of these names, and a plane without one.
SceneDescription spheres(const std::vector<std::string>& names) {
  SceneDescription description;
  std::get<ObjectItems<Plane>>(description.objects).emplace_back();
  for (const std::string& name : names) std::get<ObjectItems<Sphere>>(description.objects).push_back({{}, name, {}, 0});
  return description;
}

}  // namespace

TEST_CASE("objects without a name are called by their type and number") {
  const SceneDescription description = parsed_scene(scene_text(8, 8, 1, parts));
  CHECK(object_names(description) == std::vector<std::string>{"plane#1", "sphere#1", "the \"big\" one", "sphere#3"});
  CHECK(material_names(description) == std::vector<std::string>{"dull", "shiny"});
}

TEST_CASE("names of objects without one are never those of others") {
  const std::vector<std::string> given{"sphere#1", "sphere#2", "", "sphere#3#2", "", "sphere#6", "", "plane#1"};
  const SceneDescription description = spheres(given);
  CHECK(object_names(description) == std::vector<std::string>{"plane#1#2", "sphere#1", "sphere#2", "sphere#3",
                                                              "sphere#3#2", "sphere#5", "sphere#6", "sphere#7",
                                                              "plane#1"});
  const SceneDescription other = spheres({"sphere#3", "", "", "sphere#2", "sphere#3#2"});
  CHECK(object_names(other) ==
        std::vector<std::string>{"plane#1", "sphere#3", "sphere#2#2", "sphere#3#3", "sphere#2", "sphere#3#2"});
}

TEST_CASE("objects without a name have ids of their own, however many there are") {
  const std::vector<std::string> names = object_names(spheres(std::vector<std::string>(300'000)));
  std::set<std::uint32_t> ids;
  for (const std::string& name : names) ids.insert(cryptomatte::id_of(name));
  CHECK(ids.size() == names.size());
  const auto second = [](const std::string& name) { return std::count(name.begin(), name.end(), '#') > 1; };
  CHECK(std::count_if(names.begin(), names.end(), second) > 0);  // some hashes are the same
  CHECK(std::count_if(names.begin(), names.end(), second) < 50);
}

TEST_CASE("an object without a name has another id than one whose name has the same hash") {
  const std::string same_hash = "ball vhloqml";
  REQUIRE(cryptomatte::id_of(same_hash) == cryptomatte::id_of("sphere#1"));
  CHECK(object_names(spheres({"", same_hash})) == std::vector<std::string>{"plane#1", "sphere#1#2", same_hash});
}

TEST_CASE("a channel of ids has its names as a JSON array") {
  const ImageAttribute attribute = id_manifest("id.object", {"plane#1", "the \"big\" one"});
  CHECK(attribute.name == "raytrace:manifest/id.object");
  CHECK(nlohmann::json::parse(std::get<std::string>(attribute.value)) == nlohmann::json{"plane#1", "the \"big\" one"});
}

}  // namespace raytrace::test
