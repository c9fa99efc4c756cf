// glTF's materials of specular colour and glossiness.
#include "raytrace/import/specular_glossiness.h"

#include <string>

#include "import/gltf_read_material.h"

namespace raytrace::test {

TEST_CASE("glTF: the model of specular colour and glossiness is metal and dielectric") {
  const auto of = [](const std::string& members) { return ReadMaterial(extended("pbrSpecularGlossiness", members)); };
  const ReadMaterial plain = of("");  // a white mirror
  CHECK(plain.number("base_metalness") == Approx(1));
  CHECK(plain.at("base_color").value.red == Approx(1));
  CHECK(plain.number("specular_roughness") == 0);
  CHECK(plain.messages.empty());

  const ReadMaterial clay =
      of(R"("diffuseFactor":[0.5,0.25,0.125,1],"specularFactor":[0.04,0.04,0.04],"glossinessFactor":0.25)");
  CHECK(clay.number("base_metalness") == 0);
  CHECK(clay.number("specular_weight") == Approx(1));
  CHECK(clay.number("specular_roughness") == 0.75);
  CHECK(clay.at("base_color").value.red == Approx(0.5));
  CHECK(clay.at("base_color").value.blue == Approx(0.125));
  CHECK(clay.at("base_color").of_vertices);
  CHECK(of(R"("specularFactor":[0.01,0.01,0.01])").number("specular_weight") == Approx(0.25));
  CHECK(of(R"("specularFactor":[0,0,0])").number("specular_weight") == 0);

  const ReadMaterial gold = of(R"("diffuseFactor":[0,0,0,1],"specularFactor":[0.9,0.7,0.3])");
  CHECK(gold.number("base_metalness") == Approx(1));
  CHECK(gold.at("base_color").value.red == Approx(0.9));
  CHECK(gold.at("base_color").value.blue == Approx(0.3));

  // It counts in place of the other model, and its alpha, too.
  const ReadMaterial both(
      R"("alphaMode":"BLEND","normalTexture":{"index":3},"pbrMetallicRoughness":{"roughnessFactor":0.1,
      "baseColorFactor":[0,1,0,1]},)" +
      extended("pbrSpecularGlossiness", R"("diffuseFactor":[1,1,1,0.5],"glossinessFactor":0.5)"));
  CHECK(both.number("specular_roughness") == 0.5);
  CHECK(both.material.d == 0.5);
  CHECK(both.material.norm.file == "3.png");
}

TEST_CASE("glTF: what is part metal reflects and scatters in all as much as its two colours say") {
  for (const double diffuse : {0.0, 0.1, 0.4, 0.8})
    for (const double specular : {0.04, 0.1, 0.3, 0.9}) {
      const auto [base, metalness, weight] = metal_share({diffuse, diffuse, diffuse}, {specular, specular, specular});
      INFO(diffuse << ", " << specular << ": " << base.red << ", " << metalness);
      CHECK(weight == Approx(1));
      if (base.red == 1) continue;
      CHECK(metalness * base.red + (1 - metalness) * 0.04 == Approx(specular).margin(1e-6));
      CHECK((1 - metalness) * base.red == Approx(diffuse * (1 - specular) / 0.96).margin(1e-6));
    }
}

TEST_CASE("glTF: pictures of specular colour and glossiness become those of metal and roughness") {
  const std::string members =
      R"("diffuseFactor":[0.5,1,1,0.5],"diffuseTexture":{"index":1},"specularFactor":[1,0.5,1],"glossinessFactor":0.75,)";
  const ReadMaterial read(R"("alphaMode":"BLEND",)" +
                          extended("pbrSpecularGlossiness", members + R"("specularGlossinessTexture":{"index":2})"));
  CHECK(read.messages.empty());
  const MeshParameter &color = read.at("base_color"), &metal = read.at("base_metalness");
  REQUIRE(color.texture.made_of);
  CHECK(color.value.red == 1);
  CHECK(color.texture.made_of->is_color);
  CHECK(color.texture.made_of->diffuse.file == "1.png");
  CHECK(color.texture.made_of->specular.file == "2.png");
  CHECK(color.texture.made_of->diffuse_factor.red == 0.5);
  CHECK(color.texture.made_of->specular_factor.green == 0.5);
  CHECK(color.texture.made_of->glossiness_factor == 0.75);
  REQUIRE(metal.texture.made_of);
  CHECK_FALSE(metal.texture.made_of->is_color);
  CHECK(metal.channel == 2);
  CHECK(read.at("specular_roughness").channel == 1);
  CHECK(read.at("specular_roughness").texture.made_of == metal.texture.made_of);
  CHECK(read.at("specular_weight").channel == 0);
  CHECK(read.material.map_d.file == "1.png");
  CHECK(read.material.map_d.made_of == nullptr);
  CHECK(read.material.d == 0.5);

  const ReadMaterial apart(extended(
      "pbrSpecularGlossiness",
      members + R"("specularGlossinessTexture":{"index":2,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}})"));
  CHECK(contains(apart.messages, "has its textures at different places"));
  CHECK(apart.number("base_metalness") == 0);
  CHECK(apart.number("specular_weight") == 1);
  CHECK(apart.at("base_color").texture.file == "1.png");
  CHECK(apart.at("base_color").texture.made_of == nullptr);
  const MeshTexture& roughness = apart.at("specular_roughness").texture;
  CHECK(roughness.file == "2.png");
  CHECK(roughness.value_scale * 0.5 + roughness.value_offset == 1 - 0.75 * 0.5);
  CHECK(apart.at("specular_roughness").channel == 3);

  const ReadMaterial dull(extended(
      "pbrSpecularGlossiness",
      R"("diffuseTexture":{"index":1},"specularFactor":[0.01,0.01,0.01],"specularGlossinessTexture":{"index":2,)"
      R"("extensions":{"KHR_texture_transform":{"scale":[2,2]}}})"));
  CHECK(std::abs(dull.number("specular_weight") - 0.25) < 1e-9);
}

}  // namespace raytrace::test
