// Textures by a mesh's second set of texture coordinates.
#include <cstring>
#include <memory>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

/// A square of two sets of coordinates, as they are given.
std::string square_of_sets(const std::string& uvs, const std::string& uvs2) {
  const std::string second = uvs2.empty() ? "" : "<uvs2>" + uvs2 + "</uvs2>";
  return "<mesh><positions>-3 -3 0, 3 -3 0.5, 3 3 0.25, -3 3 0</positions><faces>0 1 2, 0 2 3</faces><uvs>" + uvs +
         "</uvs>" + second + "<material>m</material></mesh>";
}

const std::string uvs_of_corners = "0 0, 1 0, 1 1, 0 1", doubled_uvs = "0 0, 2 0, 2 2, 0 2",
                  turned_uvs = "0.25 0, 1 0.5, 0.5 1.5, 0 0.75";

/// "base" is looked up by the first set; "other" and "heights", an image and a checker, as `placed` says.
SceneDescription scene_of_sets(const std::string& material, const std::string& objects, const std::string& placed,
                               const std::string& squares_placed, const std::string& more = "") {
  SceneDescription scene = parsed_scene(scene_text(
      40, 30, 4,
      "<lights><pointlights><pointlight><location x='5' y='7' z='9'/><scaleradiance>3</scaleradiance></pointlight>"
      "</pointlights></lights><textures><images><image><name>base</name><file>made</file></image><image><name>other"
      "</name><file>made</file>" +
          placed + "</image></images><checkers><checker><name>heights</name>" + squares_placed +
          "</checker></checkers></textures><materials>" + material + "</materials><objects>" + objects + "</objects>" +
          more,
      "<eye x='1' y='2' z='9'/><lookat x='0' y='0' z='0'/>"));
  Picture picture{16, 16, 4, TexelFormat::bytes, LargeArray<std::byte>::zeros(16 * 16 * 4)};
  for (std::size_t i = 0; i < 16 * 16 * 4; ++i) picture.pixels[i] = static_cast<std::byte>(i * 37 % 251);
  const auto texels = std::make_shared<const TexelImage>(picture, true, 1);
  for (auto& image : std::get<TextureItems<Image>>(scene.textures)) image.image = {"made", texels, texels};
  return scene;
}

std::string meshes(const std::string& mesh) { return "<meshes>" + mesh + "</meshes>"; }

const std::string second_set = "<uvset>2</uvset>";

/// Each way in which materials use textures, all by two sets.
const std::string all_uses[] = {
    "<mattes><matte><name>m</name><ka>0.2</ka><kd texture='other'/><cd texture='base'/></matte></mattes>",
    "<mattes><matte><name>m</name><ka>0.2</ka><kd>0.8</kd><cd texture='base'/><opacity "
    "texture='other'/></matte></mattes>",
    "<mattes><matte><name>m</name><ka>0.2</ka><kd>0.8</kd><cd texture='base'/><normalmap "
    "texture='other'/></matte></mattes>",
    "<mattes><matte><name>m</name><ka>0.2</ka><kd>0.8</kd><cd texture='base'/><bump texture='heights' "
    "height='0.1'/></matte></mattes>",
    "<openpbrs><openpbr><name>m</name><base_color texture='base'/><emission_luminance>1</emission_luminance>"
    "<emission_color texture='other'/></openpbr></openpbrs>",
};

}  // namespace

TEST_CASE("a second set of texture coordinates that is twice the first is a texture at twice the scale") {
  const std::string twice = "<uvscale x='2' y='2'/>";
  for (const std::string& material : all_uses) {
    INFO(material);
    const FloatPicture by_sets =
        rendered(scene_of_sets(material, meshes(square_of_sets(uvs_of_corners, doubled_uvs)), second_set, second_set));
    CHECK(identical(by_sets,
                    rendered(scene_of_sets(material, meshes(square_of_sets(uvs_of_corners, "")), twice, twice))));
    CHECK_FALSE(
        identical(by_sets, rendered(scene_of_sets(material, meshes(square_of_sets(uvs_of_corners, "")), "", ""))));
  }
}

TEST_CASE("a texture by the second set is one by the first of a mesh that has only that one") {
  for (const std::string use :
       {"<kd texture='other'/>", "<kd>1</kd><opacity texture='other'/>", "<kd>1</kd><normalmap texture='other'/>",
        "<kd>1</kd><bump texture='heights' height='0.1'/>"}) {
    INFO(use);
    const std::string material =
        "<mattes><matte><name>m</name><ka>0.2</ka><cd red='1' green='0.5' blue='0.25'/>" + use + "</matte></mattes>";
    const FloatPicture wanted = rendered(scene_of_sets(material, meshes(square_of_sets(turned_uvs, "")), "", ""));
    CHECK(identical(
        rendered(scene_of_sets(material, meshes(square_of_sets(uvs_of_corners, turned_uvs)), second_set, second_set)),
        wanted));
    CHECK_FALSE(identical(rendered(scene_of_sets(material, meshes(square_of_sets(uvs_of_corners, turned_uvs)), "", "")),
                          wanted));
  }
}

TEST_CASE("shapes, and meshes without a second set, have their first one in its place") {
  const std::string objects =
      "<spheres><sphere><center x='-2' y='0' z='1'/><radius>1.5</radius><material>m</material></sphere></spheres>" +
      meshes(square_of_sets(turned_uvs, ""));
  for (const std::string& material : all_uses) {
    INFO(material);
    CHECK(identical(rendered(scene_of_sets(material, objects, second_set, second_set)),
                    rendered(scene_of_sets(material, objects, "", ""))));
  }
}

TEST_CASE("pictures by two sets do not depend on threads, samples at once or cuts, in instances neither") {
  const std::string group = "<groups><group><name>g</name><objects>" +
                            meshes(square_of_sets(uvs_of_corners, turned_uvs)) + "</objects></group></groups>";
  const std::string instances =
      "<instances><instance><group>g</group><transform><rotate x='0' y='1' z='0' angle='40'/></transform></instance>"
      "<instance><group>g</group><transform><translate x='1' y='1' z='-2'/></transform></instance></instances>"
      "<spheres><sphere><center x='2' y='0' z='1'/><radius>1</radius><material>m</material></sphere></spheres>";
  check_same_bits(scene_of_sets(all_uses[1], instances, second_set, second_set, group));
  check_same_bits(scene_of_sets(
      "<mattes><matte><name>m</name><ka>0.2</ka><kd>0.8</kd><cd texture='other'/><normalmap texture='base'/>"
      "<bump texture='heights' height='0.1'/></matte></mattes>",
      instances, second_set, second_set, group));
}

}  // namespace raytrace::test
