// The parts of models in ids of objects: the nodes of a glTF file.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/aovs/aov_table.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/gltf.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// Squares from 0 to 1 in x, from 2 to 3, and from 4 to 5, of the nodes left, right and right. The first face of each
/// is degenerate.
std::string three_squares() {
  GltfFile file;
  file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 5126, 4);
  file.add(std::vector<std::uint16_t>{0, 0, 0, 0, 1, 2, 0, 2, 3}, "SCALAR", 5123, 9);
  return file.text(
      R"("scenes":[{"nodes":[2,1,0]}],"nodes":[{"mesh":0,"name":"left"},)"
      R"({"mesh":0,"name":"right","translation":[2,0,0]},{"mesh":0,"name":"right","translation":[4,0,0]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])");
}

}  // namespace

TEST_CASE("what a glTF file has as nodes has ids of its own behind those of objects") {
  const TemporaryFolder folder;
  write_text(folder.file("a.gltf"), three_squares());
  const auto mesh = [&](const std::string& name, int x, const std::string& element = "mesh") {
    return '<' + element + '>' + name + "<file>" + folder.file("a.gltf") + "</file><transform><translate x='" +
           std::to_string(x) + "' y='0' z='0'/></transform></" + element + '>';
  };
  const SceneDescription description = parsed_scene(row_of_pixels(
      12, "<meshes>" + mesh("", 0) + mesh("<name>other</name>", 6) +
              "</meshes><spheres><sphere><name>left</name><center x='1.5' y='0.5' z='0'/><radius>0.4</radius>"
              "<material>m</material></sphere></spheres>"));
  CHECK(object_names(description) ==
        std::vector<std::string>{"left", "mesh#1", "other", "right", "left#2", "other/right", "other/left"});
  for (const std::string& isa : usable_isas())
    CHECK(object_ids(description, isa) == std::vector<std::uint32_t>{5, 1, 4, 0, 4, 0, 7, 0, 6, 0, 6, 0});
}

TEST_CASE("an instance is one object, whatever the parts of its models") {
  const TemporaryFolder folder;
  write_text(folder.file("a.gltf"), three_squares());
  const SceneDescription description =
      parsed_scene(row_of_pixels(6, "<instances><instance><name>copy</name><group>g</group></instance></instances>",
                                 "<groups><group><name>g</name><objects><meshes><mesh><file>" + folder.file("a.gltf") +
                                     "</file></mesh></meshes></objects></group></groups>"));
  CHECK(object_names(description) == std::vector<std::string>{"copy"});
  for (const std::string& isa : usable_isas())
    CHECK(object_ids(description, isa) == std::vector<std::uint32_t>{1, 0, 1, 0, 1, 0});
}

TEST_CASE("very many nodes of few names have names of their own") {
  SceneDescription description;
  auto data = std::make_shared<MeshData>();
  constexpr std::size_t count = 100'000;
  for (std::size_t i = 0; i < count; ++i) data->parts.push_back({i % 2 == 0 ? "a" : "b", i});
  std::get<ObjectItems<Mesh>>(description.objects).emplace_back().data = data;
  const std::vector<std::string> names = object_names(description);
  CHECK(names.size() == count + 1);
  CHECK(names.at(3) == "a#2");
  CHECK(names.back().starts_with("b#"));
}

}  // namespace raytrace::test
