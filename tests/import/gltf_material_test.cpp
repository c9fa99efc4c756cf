// glTF's materials in OpenPBR's terms.
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "import/gltf_read_material.h"
#include "support/contains.h"

namespace raytrace::test {

TEST_CASE("glTF: metal, roughness, base colour, normals and light") {
  const ReadMaterial plain("");
  CHECK(plain.number("base_metalness") == 1);
  CHECK(plain.number("specular_roughness") == 1);
  CHECK(plain.at("base_color").of_vertices);
  CHECK(plain.find("emission_luminance") == nullptr);
  CHECK_FALSE(plain.material.d);

  const ReadMaterial full(R"("pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1],"baseColorTexture":{"index":1},
      "metallicFactor":0.25,"roughnessFactor":0.75,"metallicRoughnessTexture":{"index":2}},
      "normalTexture":{"index":3,"scale":0.5},"emissiveFactor":[1,0.5,0],"emissiveTexture":{"index":0},)" +
                          extended("emissive_strength", R"("emissiveStrength":7)"));
  CHECK(full.messages.empty());
  CHECK(full.at("base_color").value.blue == 0.3);
  CHECK(full.at("base_color").texture.file == "1.png");
  CHECK(full.number("base_metalness") == 0.25);
  CHECK(full.at("base_metalness").channel == 2);
  CHECK(full.number("specular_roughness") == 0.75);
  CHECK(full.at("specular_roughness").channel == 1);
  CHECK(full.at("specular_roughness").texture.file == "2.png");
  CHECK(full.material.norm.file == "3.png");
  CHECK(full.material.norm.strength == 0.5);
  CHECK(full.number("emission_luminance") == 7);
  CHECK(full.at("emission_color").value.green == 0.5);
  CHECK(full.at("emission_color").texture.file == "0.png");
  CHECK_FALSE(full.material.thin_walled);
  CHECK(ReadMaterial(R"("emissiveFactor":[1,1,1],"doubleSided":true)").material.thin_walled);
}

TEST_CASE("glTF: alpha is opacity, of a mask all or nothing") {
  const auto of = [](const std::string& mode, const std::string& surface) {
    return ReadMaterial(R"("alphaMode":")" + mode + R"(","pbrMetallicRoughness":{)" + surface + "}").material;
  };
  const std::string half = R"("baseColorFactor":[1,1,1,0.4])", texture = R"(,"baseColorTexture":{"index":0})";
  CHECK_FALSE(of("OPAQUE", half + texture).d);
  CHECK(of("OPAQUE", half + texture).map_d.file.empty());
  CHECK(of("BLEND", half).d == 0.4);
  CHECK(of("BLEND", half + texture).map_d.alpha);
  CHECK(of("BLEND", half + texture).map_d.value_scale == 1);
  CHECK(of("MASK", half).d == 0);
  CHECK(of("MASK", R"("baseColorFactor":[1,1,1,0.5])").d == 1);
  const MeshMaterial mask = of("MASK", half + texture);
  CHECK(mask.d == 1);
  CHECK(mask.map_d.value_scale * 0.5 / 0.4 + mask.map_d.value_offset == Approx(0.5));
  CHECK(ReadMaterial(R"("alphaMode":"GLASS")").messages ==
        "a.gltf: error: materials[0].alphaMode: is none of OPAQUE, MASK and BLEND\n");
}

TEST_CASE("glTF: what light comes through and spreads") {
  const std::string leaf =
      R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.6,"diffuseTransmissionTexture":{"index":0},
      "diffuseTransmissionColorFactor":[0.5,0.9,0.2],"diffuseTransmissionColorTexture":{"index":1}})";
  const ReadMaterial thin(R"("extensions":{)" + leaf + "}");
  CHECK(thin.messages.empty());
  CHECK(thin.number("subsurface_weight") == 0.6);
  CHECK(thin.at("subsurface_weight").texture.file == "0.png");
  CHECK(thin.at("subsurface_weight").channel == 3);
  CHECK(thin.at("subsurface_color").value.green == 0.9);
  CHECK(thin.at("subsurface_color").texture.file == "1.png");
  CHECK(thin.number("subsurface_scatter_anisotropy") == 1);
  CHECK(thin.material.thin_walled);
  const ReadMaterial filled(R"("extensions":{)" + leaf + R"(,"KHR_materials_volume":{"thicknessFactor":1,
      "attenuationDistance":0.2,"attenuationColor":[0.36787944,0.2,0.3]}})");
  CHECK_FALSE(filled.material.thin_walled);
  CHECK(filled.number("subsurface_radius") == 0.2);
  CHECK(filled.at("subsurface_radius_scale").value.red == Approx(1));
  CHECK(filled.find("subsurface_scatter_anisotropy") == nullptr);
  const ReadMaterial solid(R"("extensions":{)" + leaf + R"(,"KHR_materials_volume":{"thicknessFactor":2}})");
  CHECK(solid.number("subsurface_radius") == Approx(0.2));
}

TEST_CASE("glTF: clear, thin and filled") {
  const std::string pane =
      R"("KHR_materials_transmission":{"transmissionFactor":0.9,"transmissionTexture":{"index":1}})";
  const ReadMaterial thin(R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1]},"extensions":{)" + pane +
                          R"(,"KHR_materials_ior":{"ior":1.33}})");
  CHECK(thin.number("transmission_weight") == 0.9);
  CHECK(thin.at("transmission_weight").texture.file == "1.png");
  CHECK(thin.material.thin_walled);
  CHECK(thin.at("transmission_color").value.red == 0.5);
  CHECK(thin.number("specular_ior") == 1.33);
  // What comes through a solid thing comes through two faces.
  const ReadMaterial solid(R"("pbrMetallicRoughness":{"baseColorFactor":[0.25,1,0,1]},"extensions":{)" + pane +
                           R"(,"KHR_materials_volume":{"thicknessFactor":1}})");
  CHECK_FALSE(solid.material.thin_walled);
  CHECK(solid.at("transmission_color").value.red == 0.5);
  CHECK(solid.at("transmission_color").value.green == 1);
  CHECK(solid.at("transmission_color").value.blue == 0);
  CHECK(solid.at("base_color").value.red == 0.25);
  const ReadMaterial filled(R"("extensions":{)" + pane + R"(,"KHR_materials_volume":{"thicknessFactor":1,
      "attenuationDistance":0.2,"attenuationColor":[0.1,0.2,0.3]}})");
  CHECK_FALSE(filled.material.thin_walled);
  CHECK(filled.number("transmission_depth") == 0.2);
  CHECK(filled.at("transmission_color").value.green == 0.2);
  CHECK(filled.find("transmission_dispersion_scale") == nullptr);
  // 20 over Abbe's number, of volumes alone.
  const auto dispersing = [&](const std::string& dispersion, const std::string& volume) {
    return ReadMaterial(R"("extensions":{)" + pane + R"(,"KHR_materials_dispersion":{"dispersion":)" + dispersion +
                        R"(},"KHR_materials_volume":{"thicknessFactor":)" + volume + "}}");
  };
  for (const auto& [dispersion, abbe] :
       {std::pair<std::string, double>{"0.5", 40}, {"2", 10}, {"1000", 1}, {"1e-300", 1e15}}) {
    const ReadMaterial glass = dispersing(dispersion, "1");
    CHECK(glass.messages.empty());
    CHECK(glass.number("transmission_dispersion_scale") == 1);
    CHECK(glass.number("transmission_dispersion_abbe_number") == abbe);
  }
  CHECK(dispersing("0", "1").find("transmission_dispersion_scale") == nullptr);
  CHECK(dispersing("0.5", "0").find("transmission_dispersion_scale") == nullptr);
}

TEST_CASE("glTF: a coat, sheen, a film and specular colours") {
  const ReadMaterial coat(
      extended("clearcoat", R"("clearcoatFactor":0.5,"clearcoatTexture":{"index":0},"clearcoatRoughnessFactor":0.2,
      "clearcoatRoughnessTexture":{"index":1},"clearcoatNormalTexture":{"index":2,"scale":0.7})"));
  CHECK(coat.number("coat_weight") == 0.5);
  CHECK(coat.at("coat_weight").channel == 0);
  CHECK(coat.number("coat_roughness") == 0.2);
  CHECK(coat.at("coat_roughness").channel == 1);
  CHECK(coat.number("coat_ior") == 1.5);
  CHECK(coat.number("coatnormalmap") == 0.7);
  CHECK(coat.at("coatnormalmap").texture.file == "2.png");
  CHECK(coat.material.norm.file.empty());
  CHECK(coat.messages.empty());
  const ReadMaterial smooth(R"("normalTexture":{"index":2},)" + extended("clearcoat", R"("clearcoatFactor":1)"));
  CHECK(smooth.find("coatnormalmap") == nullptr);

  const ReadMaterial sheen(extended("sheen", R"("sheenColorFactor":[0.1,0.4,0.2],"sheenRoughnessFactor":0.3,
      "sheenRoughnessTexture":{"index":3})"));
  CHECK(sheen.number("fuzz_weight") == 0.4);
  CHECK(sheen.at("fuzz_color").value.blue == 0.5);
  CHECK(sheen.number("fuzz_roughness") == 0.3);
  CHECK(sheen.at("fuzz_roughness").channel == 3);

  const ReadMaterial film(extended("iridescence", R"("iridescenceFactor":1,"iridescenceIor":1.8,
      "iridescenceThicknessMinimum":200,"iridescenceThicknessMaximum":800,"iridescenceThicknessTexture":{"index":0})"));
  CHECK(film.number("thin_film_weight") == 1);
  CHECK(film.number("thin_film_ior") == 1.8);
  CHECK(film.number("thin_film_thickness") == 1);
  CHECK(film.at("thin_film_thickness").channel == 1);
  CHECK(film.at("thin_film_thickness").texture.value_offset == Approx(0.2));
  CHECK(film.at("thin_film_thickness").texture.value_scale == Approx(0.6));
  CHECK(ReadMaterial(extended("iridescence", R"("iridescenceFactor":1)")).number("thin_film_thickness") == Approx(0.4));

  const std::string specular = extended("specular", R"("specularFactor":0.5,"specularColorFactor":[1,0.5,0])");
  const ReadMaterial plastic(R"("pbrMetallicRoughness":{"metallicFactor":0},)" + specular);
  CHECK(plastic.number("specular_weight") == 0.5);
  CHECK(plastic.at("specular_color").value.green == 0.5);
  CHECK(plastic.find("specular_ior") == nullptr);
  CHECK(ReadMaterial(specular).find("specular_weight") == nullptr);  // a metal keeps its edges
}

TEST_CASE("glTF: a bright specular colour is one of what reflects straight on") {
  const auto straight_on = [](double index) { return std::pow((index - 1) / (index + 1), 2); };
  const auto dielectric = [](const std::string& extensions) {
    return ReadMaterial(R"("pbrMetallicRoughness":{"metallicFactor":0},"extensions":{)" + extensions + "}");
  };
  const auto tinted = [](const std::string& color, const std::string& more = "") {
    return R"("KHR_materials_specular":{"specularColorFactor":)" + color + more + "}";
  };
  const std::string texture = R"(,"specularColorTexture":{"index":2})";
  for (const std::string& more : {std::string(), texture}) {
    const ReadMaterial shining = dielectric(tinted("[2,1,0.5]", more));
    CHECK(straight_on(shining.number("specular_ior")) == Approx(0.08));
    CHECK(shining.at("specular_color").value.red == 1);
    CHECK(shining.at("specular_color").value.blue == 0.25);
    CHECK(shining.at("specular_color").texture.file == (more.empty() ? "" : "2.png"));
  }
  const ReadMaterial dim = dielectric(tinted("[0.5,0.5,0.5]") + R"(,"KHR_materials_ior":{"ior":2})");
  CHECK(straight_on(dim.number("specular_ior")) == Approx(1 / 18.0));
  CHECK(dim.at("specular_color").value.red == 1);
  CHECK(dielectric(tinted("[0,0,0]")).at("specular_color").value.red == 0);
  CHECK(dielectric(tinted("[1e9,0,0]")).number("specular_ior") == 10);

  const ReadMaterial glass =
      dielectric(tinted("[2,1,0.5]") + R"(,"KHR_materials_transmission":{"transmissionFactor":1})");
  CHECK(glass.find("specular_ior") == nullptr);
  CHECK(glass.at("specular_color").value.red == 2);
}

TEST_CASE("glTF: below a clear coat a base reflects as it does without it") {
  const auto coated = [](const std::string& coat, const std::string& more = "") {
    return ReadMaterial(R"("pbrMetallicRoughness":{"metallicFactor":0},"extensions":{"KHR_materials_clearcoat":{)" +
                        coat + "}" + more + "}");
  };
  CHECK(coated(R"("clearcoatFactor":1)").number("specular_ior") == Approx(2.25));
  CHECK(coated(R"("clearcoatFactor":1)", R"(,"KHR_materials_ior":{"ior":1.8})").number("specular_ior") == Approx(2.7));
  CHECK(coated(R"("clearcoatFactor":0)").find("specular_ior") == nullptr);
  // The kernel's mean of the index and of that over the coat's.
  const double half = coated(R"("clearcoatFactor":0.5)").number("specular_ior");
  CHECK((half + half / 1.5) / 2 == Approx(1.5));
  const ReadMaterial painted = coated(R"("clearcoatFactor":1,"clearcoatTexture":{"index":3})");
  const MeshParameter& index = painted.at("specular_ior");
  CHECK(index.value.red == 1.5);
  CHECK(index.texture.file == "3.png");
  CHECK(index.texture.value_scale == Approx(0.5));
  CHECK(index.texture.value_offset == 1);
  CHECK(coated(R"("clearcoatFactor":1)", R"(,"KHR_materials_transmission":{"transmissionFactor":1})")
            .find("specular_ior") == nullptr);
  const ReadMaterial film = coated(R"("clearcoatFactor":1)", R"(,"KHR_materials_iridescence":{"iridescenceFactor":1})");
  CHECK(film.number("thin_film_ior") == Approx(1.3 * 1.5));
  CHECK(film.number("thin_film_thickness") == Approx(0.4 / 1.5));
}

TEST_CASE("glTF: an anisotropic surface has the alphas of OpenPBR's") {
  const ReadMaterial brushed(R"("pbrMetallicRoughness":{"roughnessFactor":0.4},)" +
                             extended("anisotropy", R"("anisotropyStrength":0.6,"anisotropyRotation":1)"));
  const double r = brushed.number("specular_roughness"), rest = 1 - brushed.number("specular_roughness_anisotropy"),
               along = r * r * std::sqrt(2 / (1 + rest * rest));
  CHECK(along == Approx(0.16 + 0.84 * 0.36));
  CHECK(along * rest == Approx(0.16));
  CHECK(brushed.messages.empty());
  CHECK(brushed.number("tangentrotation") == Approx(180 / std::numbers::pi));
  CHECK(brushed.find("tangentmap") == nullptr);

  const ReadMaterial mapped(extended("anisotropy", R"("anisotropyStrength":1,"anisotropyTexture":{"index":3})"));
  CHECK(mapped.at("specular_roughness_anisotropy").channel == 2);
  CHECK(mapped.at("tangentmap").texture.file == "3.png");
  CHECK(mapped.number("tangentmap") == 1);
  CHECK(mapped.find("tangentrotation") == nullptr);
}

TEST_CASE("glTF: what is unlit shines with its base colour and reflects nothing") {
  const ReadMaterial unlit(
      R"("pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1],"baseColorTexture":{"index":1}},)" +
      extended("unlit", ""));
  CHECK(unlit.number("base_weight") == 0);
  CHECK(unlit.number("specular_weight") == 0);
  CHECK(unlit.number("emission_luminance") == 1);
  CHECK(unlit.at("emission_color").value.green == 0.2);
  CHECK(unlit.at("emission_color").texture.file == "1.png");
  CHECK(unlit.at("emission_color").of_vertices);
  CHECK(unlit.find("base_color") == nullptr);
}

TEST_CASE("glTF: KHR_texture_transform, whose v grows downwards") {
  const ReadMaterial turned(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":1,"texCoord":1,"extensions":{
      "KHR_texture_transform":{"offset":[0.1,0.3],"rotation":0.5,"scale":[2,3],"texCoord":0}}}})");
  CHECK(turned.messages.empty());
  const MeshTexture& texture = turned.at("base_color").texture;
  CHECK(texture.rotation == Approx(0.5 * 180 / std::numbers::pi));
  const double s = std::sin(texture.rotation * std::numbers::pi / 180), c = std::cos(0.5);
  for (const double u : {0.0, 0.7})
    for (const double v : {0.0, 0.4}) {
      // As the extension has it, from the upper left corner; and ours from the lower left one.
      const double there_u = c * 2 * u + s * 3 * v + 0.1, there_v = -s * 2 * u + c * 3 * v + 0.3;
      const double x = texture.scale[0] * u, y = texture.scale[1] * (1 - v);
      CHECK(c * x - s * y + texture.offset[0] == Approx(there_u));
      CHECK(s * x + c * y + texture.offset[1] == Approx(1 - there_v));
    }
}

TEST_CASE("glTF: a material's textures have at most two sets of texture coordinates, those of its first ones") {
  GltfFile file;
  file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 5126, 3);
  file.add(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 5126, 3);
  file.add(std::vector<float>{0.5F, 0, 0.5F, 0.25F, 0, 0.5F}, "VEC2", 5126, 3);
  const std::string attributes =
      R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2,"TEXCOORD_2":1},"material":)";
  const auto read_file = [&](const std::string& primitives) {
    return read_bytes("a.gltf", file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
                                          primitives + R"(]}],
      "images":[{"uri":"0.png"},{"uri":"1.png"}],"textures":[{"source":0},{"source":1}],"materials":[{},
      {"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}},"emissiveTexture":{"index":1,"texCoord":1},
       "emissiveFactor":[1,1,1]},
      {"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"normalTexture":{"index":1,"extensions":{
       "KHR_texture_transform":{"texCoord":1}}},"emissiveTexture":{"index":1,"texCoord":2},
       "emissiveFactor":[1,1,1]}])"));
  };
  const std::vector<float> first{0, 1, 1, 1, 0, 0}, second{0.5F, 1, 0.5F, 0.75F, 0, 0.5F};
  const auto joined = [](std::vector<float> a, const std::vector<float>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const ReadResult one = read_file(attributes + "0}," + attributes + "1}," + attributes + "0}");
  REQUIRE(one.mesh);
  CHECK(one.messages.empty());
  CHECK(values(one.mesh->uvs) == joined(first, second));  // the third primitive has the first one's vertices
  CHECK(one.mesh->uvs2.empty());

  const ReadResult read = read_file(attributes + "1}," + attributes + "2}");
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->uvs) == joined(second, first));
  CHECK(values(read.mesh->uvs2) == joined(second, second));  // of a material with one set: that one
  REQUIRE(read.mesh->materials.size() == 2);
  const auto texture_of = [&](std::size_t material, std::string_view name) {
    for (const MeshParameter& parameter : read.mesh->materials[material].openpbr)
      if (parameter.name == name) return parameter.texture;
    return MeshTexture();
  };
  CHECK(texture_of(0, "base_color").file == "0.png");
  CHECK(texture_of(0, "emission_color").file == "1.png");
  CHECK_FALSE(texture_of(0, "emission_color").by_uvs2);
  CHECK(texture_of(1, "base_color").file == "0.png");
  CHECK_FALSE(texture_of(1, "base_color").by_uvs2);
  CHECK(read.mesh->materials[1].norm.file == "1.png");
  CHECK(read.mesh->materials[1].norm.by_uvs2);
  CHECK(texture_of(1, "emission_color").file.empty());
  CHECK(read.messages ==
        "a.gltf: warning: materials[2].emissiveTexture: has other coordinates than the material's TEXCOORD_0 and "
        "TEXCOORD_1, and is left out\n");
}

TEST_CASE("a hint names glTF's clear materials of solid things that have no volume") {
  // A box of corners of their own for each face, as exporters write it; without its last face it is open.
  const auto hint = [](const std::string& material, double height, std::size_t faces = 6) {
    std::vector<float> positions;
    std::vector<std::uint16_t> indices;
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        const auto first = static_cast<std::uint16_t>(positions.size() / 3);
        for (int corner = 0; corner < 4; ++corner) {
          float place[3] = {};
          place[axis] = side == 0 ? -0.0F : 1.0F;
          place[(axis + 1) % 3] = (corner == 1 || corner == 2) == (side == 1) ? 1.0F : 0.0F;
          place[(axis + 2) % 3] = corner >= 2 ? 1.0F : 0.0F;
          place[2] *= static_cast<float>(height);
          positions.insert(positions.end(), place, place + 3);
        }
        for (const int corner : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(first + corner));
      }
    indices.resize(6 * faces);
    GltfFile file;
    file.add(positions, "VEC3", 5126, 24).add(indices, "SCALAR", 5123, indices.size());
    const ReadResult read = read_bytes(
        "a.gltf", file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":
            {"POSITION":0},"indices":1,"material":0}]}],"materials":[{"name":"bottle",)" +
                            material + "}]"));
    CHECK(read.mesh);
    return read.messages;
  };
  const std::string glass = R"("KHR_materials_transmission":{"transmissionFactor":1})";
  const auto with = [](const std::string& extensions) { return R"("extensions":{)" + extensions + "}"; };
  CHECK(
      hint(with(glass), 1) ==
      "a.gltf: warning: materials[0]: 'bottle': it is clear, and a thin wall, which does not refract, though what has "
      "it is solid: a thicknessFactor above 0 (KHR_materials_volume) makes it solid\n");
  CHECK_FALSE(hint(with(glass), 0.1).empty());
  CHECK_FALSE(hint(with(glass + R"(,"KHR_materials_volume":{"thicknessFactor":0})"), 1).empty());
  CHECK(hint(with(glass + R"(,"KHR_materials_volume":{"thicknessFactor":0.1})"), 1).empty());
  CHECK(hint(with(R"("KHR_materials_transmission":{"transmissionFactor":0})"), 1).empty());
  CHECK(hint(with(""), 1).empty());
  // No sheets, and no panes of two sides.
  CHECK(hint(with(glass), 1, 5).empty());
  CHECK(hint(with(glass), 0.001).empty());
  CHECK(hint(with(glass), 0).empty());
}

}  // namespace raytrace::test
