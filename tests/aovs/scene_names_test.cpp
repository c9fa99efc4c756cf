#include <nlohmann/json.hpp>

#include "raytrace/aovs/aov_selection.h"
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

}  // namespace

TEST_CASE("objects without a name are called by their type and number") {
  const SceneDescription description = parsed_scene(scene_text(8, 8, 1, parts));
  CHECK(object_names(description) == std::vector<std::string>{"plane#1", "sphere#1", "the \"big\" one", "sphere#3"});
  CHECK(material_names(description) == std::vector<std::string>{"dull", "shiny"});
}

TEST_CASE("a channel of ids has its names as a JSON array") {
  const ImageAttribute attribute = id_manifest("id.object", {"plane#1", "the \"big\" one"});
  CHECK(attribute.name == "raytrace:manifest/id.object");
  CHECK(nlohmann::json::parse(std::get<std::string>(attribute.value)) == nlohmann::json{"plane#1", "the \"big\" one"});
}

}  // namespace raytrace::test
