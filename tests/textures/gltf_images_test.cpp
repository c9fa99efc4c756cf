// The images of glTF files, and what else their materials become.
#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/import/gltf_bytes.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/gltf.h"
#include "support/temporary_folder.h"
#include "textures/made_pictures.h"

namespace raytrace::test {

namespace {

const std::string made_gltf_members =
    R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071,"wrapT":33071}],
       "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":2},"material":0},
                                {"attributes":{"POSITION":0},"material":1}, {"attributes":{"POSITION":0}}]}],
       "materials":[{"name":"wood","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1],"baseColorTexture":{"index":0}}},
                    {"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}],"images":)";

GltfFile made_triangle() {
  GltfFile file;
  file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 5126, 3);
  file.add(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 5126, 3);
  file.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 5126, 3);
  return file;
}

/// Red and green above blue and white.
const std::string made_png_base64 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/uBfvxq7p3AAAAAElFTkSuQmCC";

/// The scene with that mesh, and what was said of it.
struct LoadedGltf {
  std::optional<SceneDescription> scene;
  std::string messages;
  bool fine = false;
};

LoadedGltf loaded_gltf(const TemporaryFolder& folder, const std::string& name) {
  write_text(folder.path() / "scene.xml",
             "<raytracer><viewplane><hres>4</hres><vres>3</vres></viewplane><camera><eye x='0' y='0' z='9'/><lookat "
             "x='0' y='0' z='0'/><viewdistance>4</viewdistance></camera><objects><meshes><mesh><file>" +
                 name + "</file></mesh></meshes></objects></raytracer>");
  Diagnostics diagnostics("scene.xml");
  LoadedGltf loaded{load_scene(folder.file("scene.xml"), diagnostics, 1), "", false};
  REQUIRE(loaded.scene);
  loaded.fine = load_meshes(*loaded.scene, diagnostics, 1);
  for (const Diagnostic& diagnostic : diagnostics.kept()) loaded.messages += diagnostic.message + "\n";
  return loaded;
}

}  // namespace

TEST_CASE("a glTF image is the same in a file, in a URI and within a GLB file") {
  const TemporaryFolder folder;
  const std::string png = *gltf::data_of_uri("data:image/png;base64," + made_png_base64);
  write_text(folder.file("two by two.png"), png);
  GltfFile with_png = made_triangle();
  with_png.add_view(png);
  write_text(folder.file("a.gltf"), made_triangle().text(made_gltf_members + R"([{"uri":"two%20by%20two.png"}])"));
  write_text(folder.file("b.gltf"), made_triangle().text(made_gltf_members + R"([{"uri":"data:image/png;base64,)" +
                                                         made_png_base64 + R"("}])"));
  write_text(folder.file("c.glb"), with_png.glb(made_gltf_members + R"([{"bufferView":3,"mimeType":"image/png"}])"));
  std::string first_hash;
  for (const char* const name : {"a.gltf", "b.gltf", "c.glb"}) {
    INFO(name);
    const LoadedGltf loaded = loaded_gltf(folder, name);
    INFO(loaded.messages);
    REQUIRE(loaded.fine);
    const auto& images = std::get<TextureItems<Image>>(loaded.scene->textures);
    REQUIRE(images.size() == 1);
    CHECK(images[0].parameters.wrap == Wrap::clamp);
    if (first_hash.empty()) first_hash = images[0].image.hash;
    CHECK(images[0].image.hash == first_hash);
    CHECK(images[0].image.bytes == nullptr);
    const TexelImage& texels = *images[0].image.color;
    CHECK(texels.srgb());
    CHECK(texel_of(texels, 0, 0, 0, false) == Color4{0, 0, 1, 1});
    CHECK(texel_of(texels, 0, 1, 1, false) == Color4{0, 1, 0, 1});
  }
}

TEST_CASE("a glTF material is an openpbr with its textures and the colours at vertices") {
  const TemporaryFolder folder;
  write_text(folder.file("a.gltf"), made_triangle().text(made_gltf_members + R"([{"uri":"data:image/png;base64,)" +
                                                         made_png_base64 + R"("}])"));
  const LoadedGltf loaded = loaded_gltf(folder, "a.gltf");
  INFO(loaded.messages);
  REQUIRE(loaded.fine);
  const auto& materials = std::get<MaterialItems<OpenPbr>>(loaded.scene->materials);
  REQUIRE(materials.size() == 2);
  const auto texture_types = [](const auto& material) {
    std::vector<std::size_t> types;
    for (const TextureUse& use : material.textures) types.push_back(use.texture.type);
    return types;
  };
  const std::size_t image = index_of<Image>(Textures{}), vertices = index_of<VertexColor>(Textures{});
  CHECK(materials[0].name == "wood");
  CHECK(materials[0].parameters.base_color.green == 0.25);
  CHECK(materials[0].parameters.base_metalness == 1);
  CHECK(materials[0].parameters.specular_roughness == 1);
  CHECK(texture_types(materials[0]) == std::vector{image, vertices});
  CHECK(materials[1].name == "paint");
  CHECK(materials[1].parameters.base_color.green == 0);
  CHECK(texture_types(materials[1]) == std::vector{vertices});
  const auto& mattes = std::get<MaterialItems<Matte>>(loaded.scene->materials);
  REQUIRE(mattes.size() == 1);
  CHECK(mattes[0].parameters.cd.green == 1);  // of what has no material
  CHECK(texture_types(mattes[0]) == std::vector{vertices});
}

TEST_CASE("a glTF image of two samplers is two images where one shows its pixels") {
  const TemporaryFolder folder;
  write_text(folder.file("a.gltf"), made_triangle().text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "textures":[{"source":0,"sampler":0},{"source":0,"sampler":1}],"samplers":[{"magFilter":9728},{"magFilter":9729}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
      "materials":[{"emissiveFactor":[1,1,1],"emissiveTexture":{"index":1},
        "pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"images":[{"uri":"data:image/png;base64,)" +
                                                         made_png_base64 + R"("}])"));
  const LoadedGltf loaded = loaded_gltf(folder, "a.gltf");
  INFO(loaded.messages);
  REQUIRE(loaded.fine);
  const auto& images = std::get<TextureItems<Image>>(loaded.scene->textures);
  REQUIRE(images.size() == 2);
  CHECK(images[0].parameters.filter == TextureFilter::nearest);
  CHECK(images[1].parameters.filter == TextureFilter::smart);
}

TEST_CASE("glTF's roughness and metalness are channels of one image, and a mask is one made sharp") {
  const TemporaryFolder folder;
  GltfFile file = made_triangle();
  write_text(folder.file("a.gltf"),
             file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"textures":[{"source":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
      "materials":[{"alphaMode":"MASK","alphaCutoff":0.25,"pbrMetallicRoughness":{"metallicFactor":0.5,
        "baseColorFactor":[1,1,1,0.5],"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0}}}],
      "images":[{"uri":"data:image/png;base64,)" +
                       made_png_base64 + R"("}])"));
  const LoadedGltf loaded = loaded_gltf(folder, "a.gltf");
  INFO(loaded.messages);
  REQUIRE(loaded.fine);
  const auto& material = std::get<MaterialItems<OpenPbr>>(loaded.scene->materials).at(0);
  const Fields& fields = element_type<OpenPbr>().fields;
  const auto use_of = [&](std::string_view field) {
    for (const TextureUse& use : material.textures)
      if (fields[use.field].name == field) return use;
    FAIL("no texture of " << field);
    return TextureUse{};
  };
  const auto& images = std::get<TextureItems<Image>>(loaded.scene->textures);
  CHECK(images.size() == 3);  // one of colours, one of numbers, and one sharp
  CHECK(use_of("base_metalness").channel == TextureChannel::blue);
  CHECK(use_of("specular_roughness").channel == TextureChannel::green);
  CHECK(use_of("base_metalness").texture.index == use_of("specular_roughness").texture.index);
  CHECK(images[use_of("base_color").texture.index].parameters.colorspace == ColorSpace::srgb);
  CHECK(images[use_of("base_metalness").texture.index].parameters.colorspace == ColorSpace::automatic);
  CHECK(material.parameters.base_metalness == 0.5);
  CHECK(use_of("opacity").channel == TextureChannel::alpha);
  const Image::Parameters& mask = images[use_of("opacity").texture.index].parameters;
  CHECK(mask.valuescale * 0.5 + mask.valueoffset == 0.5);  // at the cutoff
  CHECK(mask.valuescale * 0.52 + mask.valueoffset > 1);
  CHECK(mask.valuescale * 0.48 + mask.valueoffset < 0);
}

TEST_CASE("the alphas of a glTF file's vertices multiply the opacity's image, or are its texture") {
  const TemporaryFolder folder;
  GltfFile file = made_triangle();
  file.add(std::vector<float>{1, 0, 0, 1, 0, 1, 0, 0.5F, 0, 0, 1, 0}, "VEC4", 5126, 3);
  const auto primitive = [](int material) {
    return R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":3},"material":)" + std::to_string(material) + "}";
  };
  write_text(
      folder.file("a.gltf"), file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"textures":[{"source":0}],
      "meshes":[{"primitives":[)" + primitive(0) +
                                       ',' + primitive(1) + ',' + primitive(2) + R"(]}],
      "materials":[{"alphaMode":"MASK","alphaCutoff":0.25,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5],
        "baseColorTexture":{"index":0}}},{"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}},
        {"alphaMode":"MASK","alphaCutoff":0.75}],"images":[{"uri":"data:image/png;base64,)" +
                                       made_png_base64 + R"("}])"));
  const LoadedGltf loaded = loaded_gltf(folder, "a.gltf");
  INFO(loaded.messages);
  REQUIRE(loaded.fine);
  CHECK(loaded.messages.empty());
  const auto& materials = std::get<MaterialItems<OpenPbr>>(loaded.scene->materials);
  const auto opacity_of = [&](std::size_t material) {
    for (const TextureUse& use : materials.at(material).textures)
      if (element_type<OpenPbr>().fields[use.field].name == "opacity") return use;
    FAIL("no opacity");
    return TextureUse{};
  };
  const auto& images = std::get<TextureItems<Image>>(loaded.scene->textures);
  REQUIRE(images.size() == 2);  // that of the colour has none of it
  CHECK(materials[0].parameters.opacity == 1);
  REQUIRE(opacity_of(0).texture.type == index_of<Image>(Textures{}));
  CHECK(images[opacity_of(0).texture.index].parameters.vertexalpha);
  CHECK(opacity_of(0).channel == TextureChannel::alpha);
  CHECK_FALSE(images[1 - opacity_of(0).texture.index].parameters.vertexalpha);
  const auto& vertices = std::get<TextureItems<VertexColor>>(loaded.scene->textures);
  REQUIRE(vertices.size() == 2);  // that of the mask is made sharp
  CHECK(materials[1].parameters.opacity == 0.5);
  CHECK(opacity_of(1).channel == TextureChannel::alpha);
  CHECK(vertices[opacity_of(1).texture.index].parameters.valuescale == 1);
  CHECK(materials[2].parameters.opacity == 1);
  const VertexColor::Parameters& mask = vertices[opacity_of(2).texture.index].parameters;
  CHECK(mask.valuescale * 0.75 + mask.valueoffset == 0.5);
  CHECK(mask.valuescale > 50);
}

TEST_CASE("a glTF texture's WebP image is read in place of its other one") {
  const TemporaryFolder folder;
  std::string members = made_gltf_members;
  const std::string source = R"("source":0,)";
  members.replace(members.find(source), source.size(), R"("source":0,"extensions":{"EXT_texture_webp":{"source":1}},)");
  // Red and green above blue and white, without loss.
  const std::string webp = "UklGRiwAAABXRUJQVlA4TB8AAAAvAUAAAB8gEEjeHzqN+RcQFPwf3fxHZA/gBgwR/Q8BAA==";
  write_text(folder.file("a.gltf"),
             made_triangle().text(R"("extensionsRequired":["EXT_texture_webp"],)" + members +
                                  R"([{"uri":"missing.png"},{"uri":"data:image/webp;base64,)" + webp + R"("}])"));
  const LoadedGltf loaded = loaded_gltf(folder, "a.gltf");
  CHECK(loaded.messages.empty());
  REQUIRE(loaded.fine);
  const auto& images = std::get<TextureItems<Image>>(loaded.scene->textures);
  REQUIRE(images.size() == 1);
  CHECK(texel_of(*images[0].image.color, 0, 0, 1, true) == Color4{1, 0, 0, 1});
  CHECK(texel_of(*images[0].image.color, 0, 1, 0, true) == Color4{1, 1, 1, 1});
}

TEST_CASE("an image within a glTF file that is none is an error that names it") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& bytes) {
    write_text(folder.file("a.gltf"), made_triangle().text(made_gltf_members + R"([{"uri":"data:image/png;base64,)" +
                                                           base64(bytes) + R"("}])"));
    const LoadedGltf loaded = loaded_gltf(folder, "a.gltf");
    CHECK_FALSE(loaded.fine);
    return loaded.messages;
  };
  CHECK(contains(message("GIF89a"), "a.gltf#images[0]' cannot be used: it is neither PNG, nor JPEG, nor WebP, nor "));
  CHECK(contains(message("\x89PNG\r\n\x1a\n"), "a.gltf#images[0]' cannot be used: "));
  CHECK(contains(message("\xff\xd8\xff\xe0"), "a.gltf#images[0]' cannot be used: "));
}

TEST_CASE("pictures are made of glTF's specular colour and glossiness, pixel by pixel") {
  const TemporaryFolder folder;
  write_text(folder.file("two by two.png"), *gltf::data_of_uri("data:image/png;base64," + made_png_base64));
  const auto write = [&](const std::string& model) {
    write_text(folder.file("a.gltf"), made_triangle().text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "textures":[{"source":0},{"source":1}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
      "materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":{)" +
                                                           model +
                                                           R"(}}}],"images":[{"uri":"two%20by%20two.png"},
      {"uri":"data:image/png;base64,)" + made_png_base64 + R"("}])"));
    LoadedGltf loaded = loaded_gltf(folder, "a.gltf");
    INFO(loaded.messages);
    REQUIRE(loaded.fine);
    CHECK(loaded.messages.empty());
    return std::get<TextureItems<Image>>(loaded.scene->textures);
  };
  const auto near = [](const Color4& a, const Color4& b) {
    for (std::size_t c = 0; c < 4; ++c) CHECK(a[c] == Approx(b[c]).margin(1.0 / 255));
  };
  // Blue and white below; red and green above. What is mirrored has no colour.
  const auto clay = write(R"("diffuseTexture":{"index":0},"specularFactor":[0.02,0.02,0.02],"glossinessFactor":0.25)");
  REQUIRE(clay.size() == 2);
  near(texel_of(*clay[0].image.color, 0, 1, 1, true), {0, 1, 0, 1});
  near(texel_of(*clay[1].image.number, 0, 1, 1, false), {0.5, 0.75, 0, 1});
  // As blue, white, red and green metals.
  const auto metal =
      write(R"("diffuseFactor":[0,0,0,1],"specularGlossinessTexture":{"index":1},"specularFactor":[0.5,0.5,0.5])");
  REQUIRE(metal.size() == 2);
  near(texel_of(*metal[0].image.color, 0, 1, 1, true), {0, 0.5, 0, 1});
  near(texel_of(*metal[0].image.color, 0, 1, 0, true), {0.5, 0.5, 0.5, 1});
  near(texel_of(*metal[1].image.number, 0, 1, 0, false), {1, 0, 1, 1});
  CHECK(metal[0].image.hash != metal[1].image.hash);
  CHECK(metal[1].image.hash != clay[1].image.hash);
  // The same picture for both: what it mirrors, it does not scatter.
  const auto both = write(R"("diffuseTexture":{"index":0},"specularGlossinessTexture":{"index":1})");
  REQUIRE(both.size() == 2);
  near(texel_of(*both[1].image.number, 0, 0, 0, false), {1, 0, 1, 1});
}

}  // namespace raytrace::test
