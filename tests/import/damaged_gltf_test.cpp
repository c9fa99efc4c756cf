// glTF and GLB files with faults, and damaged ones.
#include <limits>
#include <random>

#include "import/gltf_square.h"
#include "support/contains.h"

namespace raytrace::test {

TEST_CASE("what is wrong in a glTF file is an error with its place") {
  const std::string good = square().text(of_square);
  const auto check = [](const std::string& bytes, const std::string& message) {
    CHECK(read_bytes("a.gltf", bytes).messages == "a.gltf: error: " + message + "\n");
  };
  const auto changed = [&](const std::string& what, const std::string& by, const std::string& message) {
    check(replaced(good, what, by), message);
  };
  CHECK(contains(read_bytes("a.gltf", "x").messages, "a.gltf: error: is no glTF: parse error at line 1, column 1: "));
  check("[]", "must be a JSON object");
  check("{}", "has no 'asset'");
  changed("2.0", "1.0", "is glTF '1.0', and not 2.0");
  changed(R"("meshes")", R"("extensionsRequired":["A","KHR_mesh_quantization"],"meshes")",
          "requires extensions that are not read: 'A'");
  changed(R"("scenes":[{"nodes":[0]}])", R"("scenes":[])", "has no scenes");
  changed(R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[7]}])", "scenes[0].nodes[0]: there is no nodes[7]");
  changed(R"({"mesh":0})", R"({"mesh":0.5})", "nodes[0].mesh: must be a whole number, 0 or more");
  changed(R"({"mesh":0})", R"({"mesh":0,"scale":[1,1]})", "nodes[0].scale: must have 3 numbers");
  changed(R"("indices":1)", R"("indices":-1)", "meshes[0].primitives[0].indices: must be a whole number, 0 or more");
  changed(R"("indices":1)", R"("indices":0)",
          "meshes[0].primitives[0].indices: accessors[0] has elements of 3 numbers, and not of 1");
  changed(R"("indices":1)", R"("indices":1,"material":0)",
          "meshes[0].primitives[0].material: there is no materials[0]");
  changed(R"("count":4)", R"("count":3)", "accessors[1]: has the index 3, and there are 3 vertices");
  changed(R"("count":4)", R"("count":1073741824)",
          "accessors[0]: claims 1073741824 elements, and bufferViews[0] has room for 4");
  changed(R"("count":4)", R"("count":4,"byteOffset":44)",
          "accessors[0]: claims 4 elements, and bufferViews[0] has room for 0");
  changed(R"("componentType":5126)", R"("componentType":5124)",
          "accessors[0].componentType: is none of 5120 to 5123, 5125 and 5126");
  changed(R"("byteLength":48})", R"("byteLength":48,"byteStride":4})",
          "bufferViews[0]: its byteStride, 4, is not from 12 to 252");
  changed(R"("byteLength":48})", R"("byteLength":48,"byteStride":-12})",
          "bufferViews[0].byteStride: must be a whole number, 0 or more");
  changed(R"("byteLength":48})", R"("byteLength":480})", "bufferViews[0]: ends at byte 480 of a buffer of 60");
  changed(R"("byteLength":60)", R"("byteLength":4294967296)", "buffers[0]: claims 4294967296 bytes, and there are 60");
  changed(R"(base64,)", R"(base64,?)", "buffers[0].uri: its data is not base64");
  check(square().json(of_square, "../missing.bin"),
        "buffers[0]: '../missing.bin': cannot read it: No such file or directory");
  check(square().json(of_square, "a%00b"), "buffers[0].uri: is no name of a file");
  check(square().json(of_square, ""), "buffers[0]: has no 'uri', and is not the binary chunk of a GLB file");
  check(square_with(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}])"),
        "nodes[1].children[0]: names nodes[0], which has a parent already");
  check(square_with(R"("scenes":[{"nodes":[0]}],"nodes":[{}])"), "has no faces");
  check(replaced(square().text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
          "meshes":[{"primitives":[{"attributes":{"POSITION":2}}]}])"),
                 R"("accessors":[)", R"("accessors":[{},{},{"type":"VEC3","componentType":5126,"count":1000000000,
          "sparse":{"count":1,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}}},)"),
        "accessors[2]: claims 1000000000 elements, of which the file has 1");
}

TEST_CASE("what is wrong with a glTF file's text is said whole") {
  CHECK(read_bytes("a.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,]}]})").messages ==
        "a.gltf: error: is no glTF: parse error at line 1, column 50: syntax error while parsing value - unexpected "
        "']'; expected '[', '{', or a literal\n");
  // But for what is quoted of the file.
  CHECK(read_bytes("a.gltf", R"({"nodes":[)" + std::string(500, '1') + "]}").messages ==
        "a.gltf: error: is no glTF: number overflow parsing '" + std::string(40, '1') + "...'\n");
  CHECK(read_bytes("a.gltf", R"({"asset":")" + std::string(500, 'a') + "\n\"}").messages ==
        "a.gltf: error: is no glTF: parse error at line 2, column 0: syntax error while parsing value - invalid "
        "string: control character U+000A (LF) must be escaped to \\u000A or \\n; last read: '\"" +
            std::string(39, 'a') + "...'\n");
}

TEST_CASE("the head of a GLB file must not lie") {
  const std::string good = square().glb(of_square);
  const auto message = [&](std::size_t offset, std::uint32_t word) {
    std::string bytes = good;
    return read_bytes("a.glb", bytes.replace(offset, 4, bytes_of_value(word))).messages;
  };
  CHECK(contains(message(4, 1), "a.glb: error: byte 4: is GLB of version 1, and not 2"));
  CHECK(contains(message(8, 4000000000), "byte 8: claims 4000000000 bytes, and the file has"));
  CHECK(contains(message(8, 3), "byte 8: claims 3 bytes"));
  CHECK(contains(message(12, 4000000000), "byte 12: claims a chunk of 4000000000 bytes, and there are"));
  CHECK(contains(message(16, 0x004e4942), "byte 16: the first chunk alone must be JSON"));
  const std::size_t binary = good.size() - square().buffer().size() - 8;
  CHECK(contains(message(binary, 64), "claims a chunk of 64 bytes, and there are 60"));
  CHECK(contains(read_bytes("a.glb", good.substr(0, 10)).messages, "byte 10: the file ends within its head"));
}

TEST_CASE("deep glTF files are read without deep recursion") {
  constexpr std::size_t depth = 200000;
  const std::string last = R"({"mesh":0,"translation":[1,0,0]})";
  std::string list;
  for (std::size_t i = 0; i + 1 < depth; ++i) list += "{\"children\":[" + std::to_string(i + 1) + "]},";
  CHECK(read_bytes("a.gltf", square_with(R"("scenes":[{"nodes":[0]}],"nodes":[)" + list + last + "]")).mesh);
  const std::string many(depth, '[');
  const std::string closed(depth, ']');
  CHECK(read_bytes("a.gltf", square().text(of_square + R"(,"extras":)" + many + closed)).mesh);
  CHECK_FALSE(read_bytes("a.gltf", square().text(of_square + R"(,"extras":)" + many)).mesh);
}

TEST_CASE("a glTF mesh that very many nodes have flattened takes no memory before it is refused") {
  GltfFile file;
  file.add(std::vector<std::int8_t>(300006, 1), "VEC3", 5120, 100002);
  std::string nodes, numbers;
  for (int i = 0; i < 50000; ++i) {
    nodes += std::string(i == 0 ? "" : ",") + R"({"mesh":0,"scale":[1,1,0]})";
    numbers += (i == 0 ? "" : ",") + std::to_string(i);
  }
  const ReadResult read =
      read_bytes("a.gltf", file.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":5}]}],"nodes":[)" +
                                     nodes + R"(],"scenes":[{"nodes":[)" + numbers + "]}]"));
  CHECK_FALSE(read.mesh);
  CHECK(contains(read.messages, "faces"));
}

TEST_CASE("glTF's positions that are not finite are left out with their faces") {
  GltfFile file;
  file.add(Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, std::numeric_limits<float>::infinity(), 0, 0}, "VEC3", float_type, 4);
  file.add(std::vector<std::uint8_t>{0, 1, 2, 0, 1, 3, 0, 1, 1, 2}, "SCALAR", 5121, 10);
  const ReadResult read = read_bytes("a.gltf", file.text(of_square));
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->indices) == Corners{0, 1, 2});
  CHECK(read.messages ==
        "a.gltf: warning: 1 vertices are not finite or beyond 1e18; 1 faces at them are left out\n"
        "a.gltf: warning: 2 faces have less than three different corners and are left out\n");
}

TEST_CASE("extensions that a glTF file uses are one warning") {
  const ReadResult read = read_bytes(
      "a.gltf", square().text(of_square + R"(,"extensionsUsed":["KHR_lights_punctual","KHR_mesh_quantization",
      "KHR_materials_sheen","KHR_texture_transform","KHR_materials_subsurface","B"])"));
  CHECK(read.mesh);
  CHECK(read.messages == "a.gltf: warning: uses extensions that are not read: 'KHR_materials_subsurface', 'B'\n");
}

TEST_CASE("what to do with KTX2 images in a glTF file is said where they are met") {
  const std::string used = R"("KHR_texture_basisu"])", hint =
                                                           "'KHR_texture_basisu' (its KTX2 images become PNG by: "
                                                           "gltf-transform ktxdecompress model.glb decoded.glb)";
  const std::string texture = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":
      {"POSITION":0},"indices":1,"material":0}]}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},
      "metallicRoughnessTexture":{"index":0}}}],"images":[{"uri":"a.ktx2"},{"uri":"a.png"}],"textures":[{"extensions":
      {"KHR_texture_basisu":{"source":0}}}])";
  const ReadResult required = read_bytes(
      "a.gltf", square().text(texture + R"(,"extensionsRequired":[)" + used + R"(,"extensionsUsed":[)" + used));
  CHECK_FALSE(required.mesh);
  CHECK(required.messages == "a.gltf: error: requires extensions that are not read: " + hint + '\n');
  const ReadResult alone = read_bytes("a.gltf", square().text(texture + R"(,"extensionsUsed":[)" + used));
  CHECK(alone.mesh);
  CHECK(alone.messages == "a.gltf: warning: uses extensions that are not read: " + hint +
                              "\na.gltf: warning: textures[0]: has no image but that of an extension that is not read, "
                              "and is left out\n");
  // There is another image beside it.
  const ReadResult beside =
      read_bytes("a.gltf", square().text(replaced(texture, R"([{"extensions":)", R"([{"source":1,"extensions":)") +
                                         R"(,"extensionsUsed":[)" + used));
  REQUIRE(beside.mesh);
  CHECK(beside.messages == "a.gltf: warning: uses extensions that are not read: " + hint + '\n');
}

TEST_CASE("damaged glTF files are read or refused") {
  GltfFile file = square();
  file.add(Numbers{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", float_type, 4);
  file.add_view(bytes_of(std::vector<std::uint8_t>{3, 1})).add_view(bytes_of(Numbers{0, 9, 0, 8, 0, 0}));
  file.add_accessor(R"({"bufferView":0,"type":"VEC3","componentType":5126,"count":4,"sparse":{"count":2,
      "indices":{"bufferView":3,"componentType":5121},"values":{"bufferView":4}}})");
  const std::string members = R"("scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"mesh":0,"children":[1]},{"mesh":0,"matrix":[1,0,0,0,0,-1,0,0,0,0,1,0,3,0,0,1]}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":3,"NORMAL":2},"indices":1,"material":0},
        {"attributes":{"POSITION":0},"mode":5}]}],
      "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"baseColorTexture":{"index":0}}}],
      "textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],"images":[{"bufferView":2}])";
  const std::pair<std::string, std::string> files[] = {{"a.gltf", file.text(members)}, {"a.glb", file.glb(members)}};
  const TemporaryFolder folder;
  std::mt19937 random(1);
  std::size_t good = 0, refused = 0;
  for (const auto& [name, bytes] : files)
    for (int i = 0; i < 1500; ++i) {
      std::string damaged = bytes;
      for (std::size_t edits = 1 + random() % 3; edits > 0; --edits) {
        const std::size_t at = random() % damaged.size();
        if (random() % 3 == 0)
          damaged.erase(at, 1 + random() % 3);
        else if (const std::size_t digit = damaged.find_first_of("0123456789", at); digit != std::string::npos)
          damaged[digit] = "0123456789-.e}\xff"[random() % 15];
      }
      ++(is_read_or_refused(folder.file(name), damaged) ? good : refused);
    }
  CHECK(good > 100);
  CHECK(refused > 500);
}

}  // namespace raytrace::test
