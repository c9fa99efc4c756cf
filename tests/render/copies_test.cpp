// Copies of a mesh, which a glTF file has at very many places, are in the picture as faces of one mesh would be.
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/gltf_copies.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// Six places are in view, turned, stretched and mirrored, each with one of the others, which are far behind the
/// camera.
GltfCopies six_in_view() {
  GltfCopies copies;
  constexpr float turn = 0.6F;
  copies.add(-3, 1, 0.3F, 0.08F, 1, 1);
  copies.add(0, 1, 0.3F, 0.1F, 0.5F, 1, turn, 0.8F);
  copies.add(3, 1, -0.9F, -0.06F, 1, 1);
  const std::size_t half = GltfCopies::enough / 2 + 3;
  while (copies.places() < half) copies.add(0, 0, 500 + static_cast<float>(copies.places()));
  copies.add(-3, -1, 0.3F, 0.08F, -1, 1);
  copies.add(0, -2, 0.3F, -0.1F, 1, 2, turn, 0.8F);
  copies.add(3, -2, 0.8F, 0.03F, 2, 1, -turn, 0.8F);
  while (copies.places() < 2 * half) copies.add(0, 0, 500 + static_cast<float>(copies.places()));
  return copies;
}

SceneDescription scene_of(const std::string& file, const std::string& materials, const std::string& of_mesh) {
  return parsed_scene(scene_text(
      48, 32, 4,
      "<integrator><raycast/></integrator><lights><pointlights><pointlight><location x='2' y='4' "
      "z='9'/><scaleradiance>3</scaleradiance></pointlight>"
      "</pointlights></lights><textures><checkers><checker><name>checks</name><color1 red='1' green='0.9' blue='0.8'/>"
      "<color2 red='0.1' green='0.3' "
      "blue='0.2'/><scale>0.7</scale><space>object</space></checker></checkers></textures>"
      "<materials>" +
          materials + "</materials><objects><meshes><mesh><file>" + file +
          "</file><transform><rotate x='0' y='0' z='1' angle='10'/></transform>" + of_mesh +
          "</mesh></meshes></objects>",
      "<eye x='0' y='0' z='12'/><lookat x='0' y='0' z='0'/>"));
}

}  // namespace

TEST_CASE("copies of a mesh look as its faces would at each place") {
  const TemporaryFolder folder;
  GltfCopies copies = six_in_view();
  copies.material = R"("name":"m")";
  write_text(folder.file("shared.gltf"), copies.text(1));
  write_text(folder.file("joined.gltf"), copies.text(2));
  const std::string overridden = "<overridematerials>true</overridematerials>";
  const std::string checks =
      "<mattes><matte><name>m</name><ka>0</ka><kd>0.9</kd><cd texture='checks'/></matte></mattes>";
  for (const auto& [materials, of_mesh] : {std::pair(std::string(), std::string()), std::pair(checks, overridden),
                                           std::pair(std::string(), std::string("<normals>flat</normals>"))}) {
    INFO(of_mesh);
    const SceneDescription shared = scene_of(folder.file("shared.gltf"), materials, of_mesh);
    const SceneDescription joined = scene_of(folder.file("joined.gltf"), materials, of_mesh);
    REQUIRE(std::get<ObjectItems<Mesh>>(shared.objects).front().data->copies.size() == 1);
    REQUIRE(std::get<ObjectItems<Mesh>>(joined.objects).front().data->copies.empty());
    const FloatPicture a = rendered(shared), b = rendered(joined);
    std::size_t different = 0, seen = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
      different += difference(a.pixels()[i], b.pixels()[i]) > 5e-3 ? 1 : 0;
      seen += difference(a.pixels()[i], a.pixels()[0]) > 0.02 ? 1 : 0;
    }
    CHECK(seen > 200);
    // At a few edges, rays are rounded to the other side.
    CHECK(different < 8);
  }
}

TEST_CASE("copies are parts of their mesh in ids of objects, and one object with the others in a group") {
  const TemporaryFolder folder;
  GltfCopies copies;
  for (std::size_t i = 0; i < GltfCopies::enough; ++i) copies.add(i == 1 ? 2.0F : -500.0F, 0, 0, 1.0F / 32);
  write_text(folder.file("a.gltf"),
             copies.text(1, R"(,{"name":"other","mesh":0,"translation":[4,0,0],"scale":[0.03125,1,1]})", 1));
  const std::string mesh = "<meshes><mesh><file>" + folder.file("a.gltf") + "</file></mesh></meshes>";
  using Ids = std::vector<std::uint32_t>;
  const SceneDescription alone = parsed_scene(row_of_pixels(
      6,
      mesh +
          "<spheres><sphere><name>ball</name><center x='0.5' y='0.5' z='0'/><radius>0.4</radius><material>m</material>"
          "</sphere></spheres>"));
  CHECK(object_names(alone) == std::vector<std::string>{"ball", "mesh#1", "strips", "other"});
  const SceneDescription grouped =
      parsed_scene(row_of_pixels(6,
                                 "<instances><instance><name>copy</name><group>g</group><transform>"
                                 "<translate x='-1' y='0' z='0'/></transform></instance></instances>",
                                 "<groups><group><name>g</name><objects>" + mesh + "</objects></group></groups>"));
  for (const std::string& isa : usable_isas()) {
    CHECK(object_ids(alone, isa) == Ids{1, 0, 3, 0, 4, 0});
    CHECK(object_ids(grouped, isa) == Ids{0, 1, 0, 1, 0, 0});
  }
}

TEST_CASE("copies in groups count as instances, of which a scene has only so many") {
  const TemporaryFolder folder;
  GltfCopies copies;
  for (std::size_t i = 0; i < GltfCopies::enough; ++i) copies.add(static_cast<float>(i), 0, 0);
  write_text(folder.file("a.gltf"), copies.text());
  const auto scene = [&](int nested) {
    std::string groups = "<group><name>g0</name><objects><meshes><mesh><file>" + folder.file("a.gltf") +
                         "</file></mesh></meshes></objects></group>";
    for (int i = 1; i <= nested; ++i) {
      groups += "<group><name>g" + std::to_string(i) + "</name><objects><instances>";
      for (int k = 0; k < 16; ++k) groups += "<instance><group>g" + std::to_string(i - 1) + "</group></instance>";
      groups += "</instances></objects></group>";
    }
    return scene_text(8, 6, 1,
                      "<lights/><materials/><groups>" + groups + "</groups><objects><instances><instance><group>g" +
                          std::to_string(nested) + "</group></instance></instances></objects>");
  };
  CHECK_NOTHROW(parsed_scene(scene(1)));
  std::string message;
  try {
    parsed_scene(scene(3));
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  CHECK(contains(message, "the most is 16777216"));
}

}  // namespace raytrace::test
