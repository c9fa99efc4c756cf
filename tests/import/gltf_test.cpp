// glTF and GLB files as meshes.
#include <numbers>
#include <utility>

#include "import/gltf_square.h"
#include "support/contains.h"

namespace raytrace::test {

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
  CHECK(flat.height == 4);  // whatever the scale of its node
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
  CHECK(contains(message("\"innerConeAngle\":0.25", "\"innerConeAngle\":0.75"), "its cone's angles"));
  CHECK(contains(message("\"directional\"", "\"area\""), "is none of 'directional'"));
  CHECK(contains(message("[2,2,2]", "[0,0,0]"), "leaves it no direction"));

  CHECK(wide.aspect == 0);
  CHECK(flat.aspect == 1.5);
  const auto aspect = [&](const std::string& members) {
    const ReadResult of =
        read_bytes("a.gltf", square_with(replaced(lights + cameras + nodes, "\"yfov\":1.2", members)));
    REQUIRE(of.mesh);
    return of.mesh->cameras[0].aspect;
  };
  CHECK(aspect("\"yfov\":1.2,\"aspectRatio\":0.5625") == 0.5625);
  CHECK(aspect("\"yfov\":1.2,\"aspectRatio\":-1") == 0);
}

namespace {

/// What is read of a file with a point, a spot and a sun, and then a sun, at nodes of that scale; by that exporter.
ReadResult lamps(const std::string& scale, const std::string& intensity, const std::string& cone,
                 const std::string& generator = "tests") {
  const std::string text =
      square_with(R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)"
                  R"({"type":"point","intensity":)" +
                  intensity + R"(},{"type":"spot","spot":{)" + cone +
                  R"(}},{"type":"directional"}]}},"scenes":[{"nodes":[0,1,2,3,4]}],"nodes":[{"mesh":0},)"
                  R"({"extensions":{"KHR_lights_punctual":{"light":0}},"scale":)" +
                  scale + R"(},{"extensions":{"KHR_lights_punctual":{"light":1}},"scale":)" + scale +
                  R"(},{"extensions":{"KHR_lights_punctual":{"light":2}},"scale":)" + scale +
                  R"(},{"extensions":{"KHR_lights_punctual":{"light":2}}}])");
  return read_bytes("a.gltf",
                    replaced(text, R"("version":"2.0")", R"("version":"2.0","generator":")" + generator + '"'));
}

}  // namespace

TEST_CASE("a glTF lamp that is not one is left out, and the file is read") {
  const std::string cone = R"("innerConeAngle":0.25,"outerConeAngle":0.5)";
  const auto kinds = [](const ReadResult& read) {
    std::vector<FileLight::Kind> result;
    REQUIRE(read.mesh);
    for (const FileLight& light : read.mesh->lights) result.push_back(light.kind);
    return result;
  };
  using enum FileLight::Kind;
  using Kinds = std::vector<FileLight::Kind>;
  const ReadResult all = lamps("[1,1,1]", "8", cone), negative = lamps("[1,1,1]", "-8", cone),
                   flat = lamps("[0,0,0]", "8", cone);
  CHECK(kinds(all) == Kinds{point, spot, directional, directional});
  CHECK(all.messages.empty());
  CHECK(kinds(negative) == Kinds{spot, directional, directional});
  CHECK(negative.messages ==
        "a.gltf: warning: extensions.KHR_lights_punctual.lights[0]: its colour or intensity is negative or too large: "
        "it is left out\n");
  CHECK(kinds(flat) == Kinds{point, directional});
  CHECK(flat.messages ==
        "a.gltf: warning: extensions.KHR_lights_punctual.lights[1]: its node's transform leaves it no direction: it is "
        "left out\n"
        "a.gltf: warning: extensions.KHR_lights_punctual.lights[2]: its node's transform leaves it no direction: it is "
        "left out\n");
}

TEST_CASE("a glTF spot of 180 degrees is one, although its float is above pi / 2") {
  const auto angles = [](const std::string& cone) {
    const ReadResult read = lamps("[1,1,1]", "8", cone);
    INFO(read.messages);
    REQUIRE(read.mesh);
    const FileLight& spot = read.mesh->lights.at(1);
    return std::pair(spot.inner_angle, spot.outer_angle);
  };
  constexpr double right = std::numbers::pi / 2;
  CHECK(angles(R"("innerConeAngle":1.25,"outerConeAngle":1.5707963705062866)") == std::pair(1.25, right));
  CHECK(angles(R"("innerConeAngle":1.5707963705062866,"outerConeAngle":1.5707963705062866)") ==
        std::pair(right, right));
  CHECK(contains(lamps("[1,1,1]", "8", R"("outerConeAngle":1.572)").messages, "its cone's angles"));
}

TEST_CASE("a glTF spot of Blender's has Blender's penumbra") {
  // Size 30 degrees, Blend 0.3: the numbers of docs/from-blender.md.
  const double half = 15 * std::numbers::pi / 180;
  const std::string cone =
      "\"innerConeAngle\":" + std::to_string(0.7 * half) + ",\"outerConeAngle\":" + std::to_string(half);
  const auto penumbra = [&](const std::string& of, const std::string& generator) {
    const ReadResult read = lamps("[1,1,1]", "8", of, generator);
    REQUIRE(read.mesh);
    const FileLight& spot = read.mesh->lights.at(1);
    return (spot.outer_angle - spot.inner_angle) * 180 / std::numbers::pi;
  };
  const std::string blender = "Khronos glTF Blender I/O v5.0.21";
  CHECK(penumbra(cone, blender) == Approx(2.461).epsilon(1e-3));
  CHECK(penumbra(cone, "tests") == Approx(4.5).epsilon(1e-3));
  CHECK(penumbra(R"("innerConeAngle":0.5,"outerConeAngle":0.5)", blender) == 0);
  CHECK(penumbra(R"("innerConeAngle":0,"outerConeAngle":0.5)", blender) == Approx(0.5 * 180 / std::numbers::pi));
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

}  // namespace raytrace::test
