// What an MTL calls a bump: a normal map, or heights, by its picture.
#include <OpenImageIO/imageio.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

void write_color(const std::string& file, std::array<float, 3> color, int channels, const OIIO::TypeDesc& type) {
  constexpr std::size_t pixels = 16;
  const auto output = OIIO::ImageOutput::create(file);
  REQUIRE(output);
  REQUIRE(output->open(file, OIIO::ImageSpec(4, 4, channels, type)));
  std::vector<float> numbers;
  for (std::size_t i = 0; i < pixels; ++i) numbers.insert(numbers.end(), color.begin(), color.begin() + channels);
  REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, numbers.data()));
  REQUIRE(output->close());
}

struct ReliefOfModel {
  double normalmap = 0;
  bool has_normals = false;
  std::string messages;
};

/// Of an OBJ whose material has that line.
ReliefOfModel relief_of(const TemporaryFolder& folder, const std::string& line) {
  write_text(folder.path() / "a.mtl", "newmtl m\n" + line + "\n");
  write_text(folder.path() / "a.obj",
             "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n");
  write_text(folder.path() / "scene.xml",
             "<raytracer><viewplane><hres>4</hres><vres>3</vres></viewplane><camera><eye x='0' y='0' z='9'/><lookat "
             "x='0' y='0' z='0'/><viewdistance>4</viewdistance></camera>\n<objects><models><model><file>a.obj</file>"
             "</model></models></objects></raytracer>");
  Diagnostics diagnostics("scene.xml");
  auto scene = load_scene(folder.file("scene.xml"), diagnostics, 1);
  ReliefOfModel result;
  if (scene && !load_meshes(*scene, diagnostics, 1)) scene.reset();
  for (const Diagnostic& diagnostic : diagnostics.kept())
    result.messages += std::to_string(diagnostic.location.line) + ": " + diagnostic.message + "\n";
  INFO(result.messages);
  REQUIRE(scene);
  const auto& materials = std::get<MaterialItems<Matte>>(scene->materials);
  REQUIRE(materials.size() == 1);
  result.normalmap = materials[0].parameters.normalmap;
  for (const TextureUse& use : materials[0].textures)
    result.has_normals |= element_type<Matte>().fields[use.field].name == normalmap_field;
  return result;
}

}  // namespace

TEST_CASE("an MTL's map_Bump is a normal map if its picture is blue") {
  const TemporaryFolder folder;
  write_color(folder.file("normals.png"), {0.5F, 0.5F, 1}, 3, OIIO::TypeDesc::UINT8);
  write_color(folder.file("normals16.png"), {0.6F, 0.5F, 0.9F}, 3, OIIO::TypeDesc::UINT16);
  write_color(folder.file("normals.exr"), {0.4F, 0.5F, 0.9F}, 3, OIIO::TypeDesc::FLOAT);
  write_color(folder.file("heights.png"), {0.7F, 0.7F, 0.7F}, 3, OIIO::TypeDesc::UINT8);
  write_color(folder.file("grey.png"), {0.7F, 0, 0}, 1, OIIO::TypeDesc::UINT8);
  write_color(folder.file("normals half.exr"), {0.4F, 0.5F, 0.9F}, 3, OIIO::TypeDesc::HALF);
  for (const char* const file : {"normals.png", "normals16.png", "normals.exr", "normals half.exr"})
    for (const std::string keyword : {"map_Bump", "bump"}) {
      INFO(file << " as " << keyword);
      const ReliefOfModel relief = relief_of(folder, keyword + " -bm 0.5 " + file);
      CHECK(relief.has_normals);
      CHECK(relief.normalmap == 0.5);
      CHECK(relief.messages.empty());
    }
  write_color(folder.file("heights.exr"), {0.7F, 0.7F, 0.7F}, 3, OIIO::TypeDesc::HALF);
  for (const std::string file : {"heights.png", "grey.png", "heights.exr"}) {
    INFO(file);
    const ReliefOfModel relief = relief_of(folder, "map_Bump -bm 0.5 " + file);
    CHECK_FALSE(relief.has_normals);
    CHECK(relief.messages ==
          "2: " + folder.file("a.obj") + ": the map_Bump '" + file +
              "' holds heights, and MTL does not say how high they are: it is left out; a <bump> of a material of the "
              "scene may have it, with <overridematerials>\n");
  }
  const ReliefOfModel both = relief_of(folder, "map_Bump heights.png\nnorm -bm 2 normals.png");
  CHECK(both.has_normals);
  CHECK(both.normalmap == 2);
  CHECK(both.messages.empty());
}

TEST_CASE("a warning names a material whose normal map is grey, as heights are") {
  const TemporaryFolder folder;
  const auto warning = [](const std::string& material, const std::string& file) {
    return "the normal map of the material '" + material + "', '" + file +
           "', is grey, as heights are: it slants the surface; normals can be baked from heights, and a <bump> has "
           "them as they are";
  };
  for (const auto& [name, type] : {std::pair{"h.png", OIIO::TypeDesc::UINT8},
                                   {"h16.png", OIIO::TypeDesc::UINT16},
                                   {"half.exr", OIIO::TypeDesc::HALF},
                                   {"h.exr", OIIO::TypeDesc::FLOAT}})
    for (const int channels : {1, 3}) {
      INFO(name << ' ' << channels);
      write_color(folder.file(name), {0.7F, 0.7F, 0.7F}, channels, type);
      const ReliefOfModel relief = relief_of(folder, "norm " + std::string(name));
      CHECK(relief.has_normals);
      CHECK(relief.messages == "0: " + warning("m", name) + "\n");
      write_color(folder.file(name), {0.5F, 0.5F, 0.75F}, 3, type);
      CHECK(relief_of(folder, "norm " + std::string(name)).messages.empty());
    }
  // Of a scene's material, where it stands. Other uses of such pictures are fine.
  write_color(folder.file("h.png"), {0.7F, 0.7F, 0.7F}, 3, OIIO::TypeDesc::UINT8);
  const auto said = [&](const std::string& field) {
    write_text(folder.path() / "scene.xml",
               "<raytracer><viewplane><hres>4</hres><vres>3</vres></viewplane><camera><eye x='0' y='0' z='9'/><lookat "
               "x='0' y='0' z='0'/><viewdistance>4</viewdistance></camera>\n<textures><images><image><name>h</name>"
               "<file>h.png</file></image></images></textures>\n<materials><openpbrs>\n  <openpbr><name>tiles</name>" +
                   field + "</openpbr></openpbrs></materials></raytracer>");
    Diagnostics diagnostics("scene.xml");
    CHECK(load_scene(folder.file("scene.xml"), diagnostics, 1));
    std::string messages;
    for (const Diagnostic& diagnostic : diagnostics.kept())
      messages += std::to_string(diagnostic.location.line) + ":" + std::to_string(diagnostic.location.column) + ": " +
                  diagnostic.message + "\n";
    return messages;
  };
  CHECK(said("<normalmap texture='h'/>") == "4:3: " + warning("tiles", "h.png") + "\n");
  CHECK(said("<coatnormalmap texture='h'/>") == "4:3: " + warning("tiles", "h.png") + "\n");
  CHECK(said("<bump texture='h' height='1'/> <base_color texture='h'/>").empty());
}

}  // namespace raytrace::test
