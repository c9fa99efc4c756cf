// glTF and GLB files as meshes.
#include "support/gltf.h"

#include <random>

#include "import/support.h"
#include "support/catch.h"
#include "support/contains.h"

using namespace raytrace;
using namespace raytrace::test;

namespace {

using Corners = std::vector<std::uint32_t>;
using Numbers = std::vector<float>;
constexpr int float_type = 5126;

/// One node, and one mesh of one primitive.
std::string primitive(const std::string& members) {
  return R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{)" + members + "}]}]";
}

/// A unit square: positions 0, indices 1.
GltfFile square() {
  GltfFile file;
  file.add(Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", float_type, 4);
  file.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 5123, 6);
  return file;
}
const std::string of_square = primitive(R"("attributes":{"POSITION":0},"indices":1)");

std::string square_with(const std::string& members) {
  return square().text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" + members);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

Corners corners_of(const std::string& bytes) {
  const ReadResult read = read_bytes("a.gltf", bytes);
  INFO(read.messages);
  REQUIRE(read.mesh);
  return values(read.mesh->indices);
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

}  // namespace

TEST_CASE("a glTF file has its buffer in a URI, in a file beside it or in a GLB file") {
  const Numbers positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const auto check = [&](const std::string& name, const std::string& bytes) {
    INFO(name);
    const ReadResult read = read_bytes(name, bytes);
    CHECK(read.messages.empty());
    REQUIRE(read.mesh);
    CHECK(values(read.mesh->positions) == positions);
    CHECK(values(read.mesh->indices) == Corners{0, 1, 2, 0, 2, 3});
  };
  check("a.gltf", square().text(of_square));
  check("a.glb", square().glb(of_square));
  check("a.gltf", square().glb(of_square));

  const TemporaryFolder folder;
  write_text(folder.file("the data+.bin"), square().buffer() + "more");
  write_text(folder.file("a.gltf"), square().json(of_square, "the%20data+.bin"));
  Diagnostics diagnostics("a.gltf");
  const auto mesh = read_mesh(folder.file("a.gltf"), {}, diagnostics);
  REQUIRE(mesh);
  CHECK(values(mesh->positions) == positions);
}

TEST_CASE("a glTF vertex has a normal, texture coordinates and a linear colour") {
  GltfFile file = square();
  file.add(Numbers{0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC3", float_type, 4);
  file.add(std::vector<std::uint16_t>{0, 0, 65535, 0, 65535, 65535, 0, 13107}, "VEC2", 5123, 4,
           R"(,"normalized":true)");
  file.add(std::vector<std::uint8_t>{255, 0, 51, 255, 0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9}, "VEC4", 5121, 4,
           R"(,"normalized":true)");
  const ReadResult read = read_bytes(
      "a.gltf",
      file.text(primitive(R"("attributes":{"POSITION":0,"NORMAL":2,"TEXCOORD_0":3,"COLOR_0":4},"indices":1)")));
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->normals) == Numbers{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0});
  CHECK(values(read.mesh->uvs) == Numbers{0, 1, 1, 1, 1, 0, 0, 0.8F});
  CHECK(values(read.mesh->colors) == Numbers{1, 0, 0.2F, 0, 0, 0, 0, 0, 0, 0, 0, 0});
}

TEST_CASE("glTF's triangles, strips and fans, with and without indices") {
  GltfFile file;
  file.add(Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0}, "VEC3", float_type, 6);
  file.add(std::vector<std::uint8_t>{5, 4, 3, 2}, "SCALAR", 5121, 4);
  file.add(std::vector<std::uint32_t>{5, 4, 3}, "SCALAR", 5125, 3);
  const auto corners = [&](const std::string& more) {
    return corners_of(file.text(primitive(R"("attributes":{"POSITION":0})" + more)));
  };
  CHECK(corners("") == Corners{0, 1, 2, 3, 4, 5});
  CHECK(corners(R"(,"indices":2)") == Corners{5, 4, 3});
  CHECK(corners(R"(,"mode":5)") == Corners{0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4});
  CHECK(corners(R"(,"mode":5,"indices":1)") == Corners{5, 4, 3, 4, 2, 3});
  CHECK(corners(R"(,"mode":6,"indices":1)") == Corners{4, 3, 5, 3, 2, 5});
  const ReadResult read =
      read_bytes("a.gltf", file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[
        {"attributes":{"POSITION":0},"mode":1},{"attributes":{"POSITION":0}},{"attributes":{}}]}])"));
  CHECK(read.mesh);
  CHECK(read.messages == "a.gltf: warning: 2 primitives of points or lines, or without positions, are left out\n");
}

TEST_CASE("glTF's nodes place meshes, and a mirrored one keeps its front") {
  GltfFile file;
  file.add(Numbers{1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", float_type, 3);
  file.add(Numbers{1, 1, 0, 1, 1, 0, 1, 1, 0}, "VEC3", float_type, 3);
  const ReadResult read = read_bytes("a.gltf", file.text(R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[1,0]}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1}}]}],
      "nodes":[{"mesh":0,"matrix":[-2,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1]},
               {"mesh":0,"translation":[10,0,0],"children":[2]},
               {"mesh":0,"rotation":[0,0,0.70710678118654757,0.70710678118654757],"scale":[1,2,3]}])"));
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->positions) == Numbers{11, 0, 0, 10, 1, 0, 10, 0, 1,    // moved
                                                10, 1, 0, 8,  0, 0, 10, 0, 3,    // its child, stretched, turned
                                                3,  0, 0, 5,  1, 0, 5,  0, 1});  // mirrored
  CHECK(values(read.mesh->indices) == Corners{0, 1, 2, 3, 4, 5, 6, 8, 7});
  const auto normal = [&](std::size_t vertex) {
    return Vec3d{read.mesh->normals[3 * vertex], read.mesh->normals[3 * vertex + 1],
                 read.mesh->normals[3 * vertex + 2]};
  };
  const auto is_near = [](const Vec3d& a, const Vec3d& b) { return length(a - b * (1 / length(b))) < 1e-6; };
  CHECK(is_near(normal(0), {1, 1, 0}));
  CHECK(is_near(normal(3), {-0.5, 1, 0}));
  CHECK(is_near(normal(6), {-0.5, 1, 0}));
}

TEST_CASE("glTF's tangents are placed with their nodes, where there are normals") {
  GltfFile file;
  file.add(Numbers{1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", float_type, 3);
  file.add(Numbers{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", float_type, 3);
  file.add(Numbers{1, 0, 0, 1, 0, 1, 0, -1, 1, 1, 0, 1}, "VEC4", float_type, 3);
  const auto read = [&](const std::string& attributes) {
    const ReadResult result = read_bytes("a.gltf", file.text(R"("scenes":[{"nodes":[0,1]}],"nodes":[
        {"mesh":0,"rotation":[0,0,0.70710678118654757,0.70710678118654757],"scale":[3,1,1]},
        {"mesh":0,"scale":[-1,1,1]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0)" +
                                                             attributes + "}}]}]"));
    INFO(result.messages);
    REQUIRE(result.mesh);
    return values(result.mesh->tangents);
  };
  const Numbers tangents = read(R"(,"NORMAL":1,"TANGENT":2)");
  const auto a = static_cast<float>(std::sqrt(0.1)), b = static_cast<float>(std::sqrt(0.5));
  const Numbers wanted{0,  1, 0, 1,  -1, 0, 0, -1, -a, 3 * a, 0, 1,    // turned and stretched
                       -1, 0, 0, -1, 0,  1, 0, 1,  -b, b,     0, -1};  // mirrored
  REQUIRE(tangents.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    INFO(i);
    CHECK(std::abs(tangents[i] - wanted[i]) < 1e-6F);
  }
  CHECK(read(R"(,"TANGENT":2)").empty());
  CHECK(read(R"(,"NORMAL":1)").empty());
}

TEST_CASE("glTF's cameras and lights stand where their nodes are") {
  const std::string lights =
      R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)"
      R"({"type":"point","color":[1,0.5,0.25],"intensity":8},{"type":"spot","name":"lamp","spot":{"innerConeAngle":0.25,)"
      R"("outerConeAngle":0.5}},{"type":"directional","intensity":3}]}},)";
  const std::string cameras =
      R"("cameras":[{"type":"perspective","name":"wide","perspective":{"yfov":1.2,"znear":0.1}},)"
      R"({"type":"orthographic","orthographic":{"xmag":3,"ymag":2,"znear":0,"zfar":9}}],)";
  const std::string nodes =
      R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"translation":[1,2,3],"scale":[2,2,2],"children":[2,3,4,5,6]},)"
      R"({"camera":0,"rotation":[0,0.7071067811865476,0,0.7071067811865476],"translation":[0,0,1]},{"camera":1},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":0}}},{"extensions":{"KHR_lights_punctual":{"light":1}},)"
      R"("rotation":[-0.7071067811865476,0,0,0.7071067811865476]},{"extensions":{"KHR_lights_punctual":{"light":2}}}])";
  const ReadResult read = read_bytes("a.gltf", square_with(lights + cameras + nodes));
  CHECK(read.messages.empty());
  REQUIRE(read.mesh);
  const auto near = [](const Vec3d& a, const Vec3d& b) { return length(a - b) < 1e-12; };
  REQUIRE(read.mesh->cameras.size() == 2);
  const FileCamera &wide = read.mesh->cameras[0], &flat = read.mesh->cameras[1];
  CHECK(wide.name == "wide");
  CHECK(wide.angle == 1.2);
  CHECK(near(wide.eye, {1, 2, 5}));
  CHECK(near(wide.forward, {-1, 0, 0}));
  CHECK(near(wide.up, {0, 1, 0}));
  CHECK(flat.angle == 0);
  CHECK(flat.height == 8);
  CHECK(near(flat.forward, {0, 0, -1}));
  REQUIRE(read.mesh->lights.size() == 3);
  const FileLight &point = read.mesh->lights[0], &spot = read.mesh->lights[1], &sun = read.mesh->lights[2];
  CHECK(point.kind == FileLight::Kind::point);
  CHECK((point.intensity.red == 8 && point.intensity.green == 4 && point.intensity.blue == 2));
  CHECK(near(point.position, {1, 2, 3}));
  CHECK(spot.kind == FileLight::Kind::spot);
  CHECK(spot.name == "lamp");
  CHECK(near(spot.direction, {0, -1, 0}));
  CHECK((spot.inner_angle == 0.25 && spot.outer_angle == 0.5));
  CHECK(sun.kind == FileLight::Kind::directional);
  CHECK(sun.intensity.green == 3);

  const auto message = [&](const std::string& what, const std::string& by) {
    return read_bytes("a.gltf", square_with(replaced(lights + cameras + nodes, what, by))).messages;
  };
  CHECK(contains(message("\"yfov\":1.2", "\"yfov\":4"), "cameras[0].perspective.yfov: is not between 0 and pi"));
  CHECK(contains(message("\"ymag\":2", "\"ymag\":0"), "cameras[1].orthographic.ymag: is 0"));
  CHECK(contains(message("\"orthographic\",\"ortho", "\"fisheye\",\"ortho"), "is neither 'perspective' nor"));
  CHECK(contains(message("\"camera\":1", "\"camera\":2"), "there is no cameras[2]"));
  CHECK(contains(message("\"light\":2", "\"light\":3"), "there is no such light"));
  CHECK(contains(message("\"intensity\":8", "\"intensity\":-8"), "is negative or too large"));
  CHECK(contains(message("\"innerConeAngle\":0.25", "\"innerConeAngle\":0.75"), "its cone's angles"));
  CHECK(contains(message("\"directional\"", "\"area\""), "is none of 'directional'"));
  CHECK(contains(message("[2,2,2]", "[0,0,0]"), "leaves it no direction"));
}

TEST_CASE("glTF's primitives are one mesh with a material for each face") {
  GltfFile file = square();
  file.add(Numbers{0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F}, "VEC2", float_type, 4);
  const ReadResult read = read_bytes("a.gltf", file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":2},
        {"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1},
        {"attributes":{"POSITION":0},"indices":1,"material":0}]}],
      "materials":[{"name":"red","pbrMetallicRoughness":{"baseColorFactor":[0.5,0,2,1],"baseColorTexture":{"index":0}}},
        {"name":"unused"},{"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}}],
      "textures":[{"source":0,"sampler":0},{"source":1}],
      "samplers":[{"wrapS":33648,"wrapT":33071,"magFilter":9728,"minFilter":9987}],
      "images":[{"uri":"textures/my%20wood.png"},{"uri":"data:image/png;base64,AAEC/w=="}])"));
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(read.messages.empty());
  CHECK(read.mesh->vertex_count() == 8);
  CHECK(values(read.mesh->indices) == Corners{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 0, 1, 2, 0, 2, 3});
  CHECK(values(read.mesh->uvs) == Numbers{0, 0, 0, 0, 0, 0, 0, 0, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F});
  CHECK(values(read.mesh->face_materials) == Corners{0, 0, MeshData::no_material, MeshData::no_material, 1, 1});
  REQUIRE(read.mesh->materials.size() == 2);
  const MeshMaterial &first = read.mesh->materials[0], &red = read.mesh->materials[1];
  CHECK(red.name == "red");
  const MeshParameter &first_base = first.openpbr.at(0), &red_base = red.openpbr.at(0);
  CHECK(red_base.name == "base_color");
  CHECK(red_base.value.red == 0.5);
  CHECK(red_base.value.blue == 1);
  CHECK(red_base.texture.file == "textures/my wood.png");
  CHECK(red_base.texture.edge_u == MeshTexture::Edge::mirror);
  CHECK(red_base.texture.edge_v == MeshTexture::Edge::clamp);
  CHECK(red_base.texture.nearest);
  CHECK(first.name == "materials[2]");
  CHECK(first_base.value.green == 1);
  CHECK_FALSE(first_base.texture.nearest);
  REQUIRE(first_base.texture.bytes);
  CHECK(*first_base.texture.bytes == std::string("\0\1\2\xff", 4));
}

TEST_CASE("glTF's interleaved and sparse accessors") {
  GltfFile interleaved;
  interleaved.add(Numbers{0, 0, 0, 7, 1, 0, 0, 7, 0, 1, 0, 7}, "VEC3", float_type, 3, R"(,"byteOffset":0)");
  const std::string text = interleaved.text(primitive(R"("attributes":{"POSITION":0})"));
  const ReadResult read =
      read_bytes("a.gltf", replaced(text, R"("byteLength":48})", R"("byteLength":48,"byteStride":16})"));
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->positions) == Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0});

  GltfFile sparse = square();
  sparse.add_view(bytes_of(std::vector<std::uint8_t>{3, 1})).add_view(bytes_of(Numbers{0, 9, 0, 8, 0, 0}));
  const std::string changes = R"("type":"VEC3","componentType":5126,"count":4,"sparse":{"count":2,
      "indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":3}}})";
  sparse.add_accessor(R"({"bufferView":0,)" + changes).add_accessor("{" + changes);
  const auto positions = [&](int accessor) {
    const ReadResult changed = read_bytes(
        "a.gltf",
        sparse.text(primitive(R"("attributes":{"POSITION":)" + std::to_string(accessor) + R"(},"indices":1)")));
    INFO(changed.messages);
    REQUIRE(changed.mesh);
    return values(changed.mesh->positions);
  };
  CHECK(positions(2) == Numbers{0, 0, 0, 8, 0, 0, 1, 1, 0, 0, 9, 0});
  CHECK(positions(3) == Numbers{0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 9, 0});
}

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

TEST_CASE("a glTF mesh that very many nodes have takes no memory before it is refused") {
  GltfFile file;
  file.add(std::vector<std::int8_t>(300006, 1), "VEC3", 5120, 100002);
  std::string nodes, numbers;
  for (int i = 0; i < 50000; ++i) {
    nodes += i == 0 ? R"({"mesh":0})" : R"(,{"mesh":0})";
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
