// glTF files with primitives that Draco has compressed.
#include "import/support.h"
#include "support/contains.h"
#include "support/gltf.h"

#if defined(RAYTRACE_DRACO)

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include <array>
#include <cmath>
#include <random>

using namespace raytrace;
using namespace raytrace::test;

namespace {

constexpr std::uint32_t side = 12;
constexpr std::size_t vertex_total = side * side, face_total = 2 * (side - 1) * (side - 1);

/// What vertex i of a wavy sheet has. The positions are whole numbers, by which vertices are known again in another
/// order.
std::array<float, 3> position_of(std::size_t i) {
  const std::size_t x = i % side, y = i / side;
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>((x * x + 3 * y) % 4)};
}
std::array<float, 3> normal_of(std::size_t i) {
  const auto [x, y, z] = position_of(i);
  const float size = std::hypot(x + 1, y - 5, z + 2);
  return {(x + 1) / size, (y - 5) / size, (z + 2) / size};
}
std::array<float, 2> uv_of(std::size_t i) {
  return {static_cast<float>(i % side) / side, static_cast<float>(i / side) / side};
}
std::array<std::uint8_t, 4> color_of(std::size_t i) {
  return {static_cast<std::uint8_t>(5 * i), static_cast<std::uint8_t>(255 - i), static_cast<std::uint8_t>(i % 3),
          static_cast<std::uint8_t>(3 * i)};
}

std::vector<std::array<std::uint32_t, 3>> sheet_faces() {
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t first = y * side + x, above = first + side;
      faces.push_back({first, first + 1, above + 1});
      faces.push_back({first, above + 1, above});
    }
  return faces;
}

template <class Of>
int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType data, bool normalized,
                  const Of& value_of) {
  const auto first = value_of(0);
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<std::uint8_t>(first.size()), data, normalized, sizeof first, 0);
  const int id = mesh.AddAttribute(attribute, true, vertex_total);
  for (std::uint32_t i = 0; i < vertex_total; ++i) {
    const auto value = value_of(i);
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), value.data());
  }
  return id;
}

/// Attributes 0 to 3: positions, normals, texture coordinates and colours.
std::string encoded_sheet(draco::MeshEncoderMethod method) {
  draco::Mesh mesh;
  mesh.set_num_points(vertex_total);
  using Attribute = draco::GeometryAttribute;
  add_attribute(mesh, Attribute::POSITION, draco::DT_FLOAT32, false, position_of);
  add_attribute(mesh, Attribute::NORMAL, draco::DT_FLOAT32, false, normal_of);
  add_attribute(mesh, Attribute::TEX_COORD, draco::DT_FLOAT32, false, uv_of);
  add_attribute(mesh, Attribute::COLOR, draco::DT_UINT8, true, color_of);
  for (const auto& face : sheet_faces())
    mesh.AddFace({draco::PointIndex(face[0]), draco::PointIndex(face[1]), draco::PointIndex(face[2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(Attribute::POSITION, 14);
  encoder.SetAttributeQuantization(Attribute::NORMAL, 10);
  encoder.SetAttributeQuantization(Attribute::TEX_COORD, 12);
  draco::EncoderBuffer buffer;
  REQUIRE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

/// Accessors 0 to 3 of the attributes, and 4 of the corners; view 0 is the compressed mesh.
GltfFile compressed_sheet(draco::MeshEncoderMethod method = draco::MESH_EDGEBREAKER_ENCODING) {
  const auto accessor = [](const std::string& type, int component_type, std::size_t count) {
    return "{\"type\":\"" + type + "\",\"componentType\":" + std::to_string(component_type) +
           ",\"count\":" + std::to_string(count) + "}";
  };
  GltfFile file;
  file.add_view(encoded_sheet(method));
  file.add_accessor(accessor("VEC3", 5126, vertex_total)).add_accessor(accessor("VEC3", 5126, vertex_total));
  file.add_accessor(accessor("VEC2", 5126, vertex_total)).add_accessor(accessor("VEC4", 5121, vertex_total));
  return file.add_accessor(accessor("SCALAR", 5125, 3 * face_total));
}

const std::string all_attributes = R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"COLOR_0":3)";

/// A primitive. compressed: those of its attributes that the mesh has.
std::string sheet_primitive(const std::string& compressed = all_attributes,
                            const std::string& attributes = all_attributes, const std::string& more = "") {
  return R"({"attributes":{)" + attributes + R"(},"indices":4)" + more +
         R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{)" + compressed + "}}}}";
}
std::string draco_scene(const std::string& primitives) {
  return R"("extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"],)"
         R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
         primitives + "]}]";
}

MeshData read_sheet(const GltfFile& file, const std::string& primitives) {
  MeshReadSettings settings;
  settings.vertex_alphas = true;
  ReadResult read = read_bytes("a.glb", file.glb(draco_scene(primitives)), settings);
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(read.messages.empty());
  return std::move(*read.mesh);
}

/// The number of the vertex that is there; vertex_total: none.
std::size_t vertex_at(const float* position) {
  for (std::size_t i = 0; i < vertex_total; ++i) {
    const auto expected = position_of(i);
    if (std::abs(position[0] - expected[0]) < 0.002F && std::abs(position[1] - expected[1]) < 0.002F &&
        std::abs(position[2] - expected[2]) < 0.002F)
      return i;
  }
  return vertex_total;
}

/// Of numbers of vertices; `vertices` has the one of each.
template <class Of>
double error_of(const MeshBuffer<float>& buffer, const std::vector<std::size_t>& vertices, std::size_t numbers,
                const Of& expected) {
  REQUIRE(buffer.size() == numbers * vertices.size());
  double error = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t k = 0; k < numbers; ++k)
      error = std::max(error, std::abs(double{buffer[numbers * i + k]} - double{expected(vertices[i], k)}));
  return error;
}

/// Faces by the numbers of their vertices, each from its least, in order.
std::vector<std::array<std::size_t, 3>> known_faces(const MeshBuffer<std::uint32_t>& indices,
                                                    const std::vector<std::size_t>& vertices) {
  std::vector<std::array<std::size_t, 3>> faces;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    std::array<std::size_t, 3> face{vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]]};
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

void check_sheet(const MeshData& mesh) {
  REQUIRE(mesh.vertex_count() == vertex_total);
  std::vector<std::size_t> vertices;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    vertices.push_back(vertex_at(&mesh.positions[3 * i]));
    REQUIRE(vertices.back() < vertex_total);
  }
  CHECK(error_of(mesh.positions, vertices, 3, [](auto i, auto k) { return position_of(i)[k]; }) < 0.001);
  CHECK(error_of(mesh.normals, vertices, 3, [](auto i, auto k) { return normal_of(i)[k]; }) < 0.01);
  CHECK(error_of(mesh.uvs, vertices, 2, [](auto i, auto k) { return k == 0 ? uv_of(i)[k] : 1 - uv_of(i)[k]; }) < 0.001);
  CHECK(error_of(mesh.colors, vertices, 3, [](auto i, auto k) { return color_of(i)[k] / 255.0F; }) < 1e-6);
  CHECK(error_of(mesh.alphas, vertices, 1, [](auto i, auto) { return color_of(i)[3] / 255.0F; }) < 1e-6);
  std::vector<std::array<std::size_t, 3>> expected;
  for (const auto& face : sheet_faces()) expected.push_back({face[0], face[1], face[2]});  // each from its least
  std::sort(expected.begin(), expected.end());
  CHECK(known_faces(mesh.indices, vertices) == expected);
}

}  // namespace

TEST_CASE("a primitive that Draco has compressed is as it was before") {
  for (const auto method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    INFO(static_cast<int>(method));
    check_sheet(read_sheet(compressed_sheet(method), sheet_primitive()));
    // What is decoded is triangles, of what was a strip as well, whose accessor has fewer corners.
    std::string strip = sheet_primitive(all_attributes, all_attributes, R"(,"mode":5)");
    strip.replace(strip.find("\"indices\":4"), 11, "\"indices\":5");
    const std::string corners =
        R"({"type":"SCALAR","componentType":5125,"count":)" + std::to_string(face_total + 2) + "}";
    check_sheet(read_sheet(compressed_sheet(method).add_accessor(corners), strip));
  }
}

TEST_CASE("a primitive of Draco has other attributes from their accessors") {
  GltfFile file = compressed_sheet(draco::MESH_SEQUENTIAL_ENCODING);  // which keeps the vertices' order
  std::vector<std::uint8_t> colors;
  for (std::size_t i = 0; i < vertex_total; ++i)
    for (const std::uint8_t value : color_of(i)) colors.push_back(value);
  file.add(colors, "VEC4", 5121, vertex_total, R"(,"normalized":true)");
  check_sheet(read_sheet(file, sheet_primitive(R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":2)",
                                               R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"COLOR_0":5)")));
}

TEST_CASE("Draco's integers become an accessor's numbers, normalized") {
  const std::string of_colors = R"({"type":"VEC4","componentType":5126,"count":)" + std::to_string(vertex_total) + "}";
  check_sheet(read_sheet(compressed_sheet().add_accessor(of_colors),
                         sheet_primitive(all_attributes, R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"COLOR_0":5)")));
}

TEST_CASE("primitives that name the same mesh of Draco share its vertices") {
  const MeshData mesh = read_sheet(compressed_sheet(), sheet_primitive() + ',' + sheet_primitive());
  CHECK(mesh.vertex_count() == vertex_total);
  CHECK(mesh.face_count() == 2 * face_total);
}

TEST_CASE("what is wrong in a primitive of Draco is an error with its place") {
  const std::string place = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
  const auto check = [](const GltfFile& file, const std::string& primitives, const std::string& message) {
    const std::string messages = read_bytes("a.glb", file.glb(draco_scene(primitives))).messages;
    INFO(messages);
    CHECK(contains(messages, "a.glb: error: " + message));
  };
  const auto with = [](const std::string& bytes, std::size_t vertices, std::size_t faces) {
    GltfFile file;
    file.add_view(bytes);
    file.add_accessor(R"({"type":"VEC3","componentType":5126,"count":)" + std::to_string(vertices) + "}");
    for (int i = 0; i < 3; ++i) file.add_accessor("{}");
    return file.add_accessor(R"({"type":"SCALAR","componentType":5125,"count":)" + std::to_string(3 * faces) + "}");
  };
  const std::string good = encoded_sheet(draco::MESH_EDGEBREAKER_ENCODING);
  const std::string positions = sheet_primitive(R"("POSITION":0)", R"("POSITION":0)");
  check(with(good, vertex_total, face_total - 1), positions,
        place + ": its data has 242 faces, and its accessors have 241");
  check(with(good, vertex_total - 1, face_total), positions,
        place + ": its data has 144 points, and its accessors have 143");
  check(with(good.substr(0, good.size() / 2), vertex_total, face_total), positions, place + ": its data is damaged: ");
  check(with("", vertex_total, face_total), positions, place + ": its data is no mesh that Draco has compressed");
  check(with(good.substr(0, 7) + '\0' + good.substr(8), vertex_total, face_total), positions,
        place + ": its data is no mesh");
  check(with(good.substr(0, 6) + '\1' + good.substr(7), vertex_total, face_total), positions,
        place + ": its data is of Draco's format 2.1, and not 2.2");
  check(compressed_sheet(), sheet_primitive(R"("POSITION":9)"),
        place + ".attributes.POSITION: the compressed mesh has no attribute");
  check(compressed_sheet(), sheet_primitive(R"("POSITION":2)"),
        place + ".attributes.POSITION: the compressed mesh has elements of 2 numbers, and accessors[0] of 3");
  check(compressed_sheet(), sheet_primitive(R"("TEXCOORD_1":2)"),
        "meshes[0].primitives[0].attributes: has no 'TEXCOORD_1'");
  GltfFile sparse = compressed_sheet();
  sparse.add_accessor(R"({"type":"VEC3","componentType":5126,"count":144,"sparse":{}})");
  check(sparse, sheet_primitive(all_attributes, R"("POSITION":5,"NORMAL":1,"TEXCOORD_0":2,"COLOR_0":3)"),
        "accessors[5]: is sparse, and of a primitive that Draco has compressed");
  GltfFile bytes = compressed_sheet();
  bytes.add_accessor(R"({"type":"VEC3","componentType":5121,"count":144})");
  check(bytes, sheet_primitive(all_attributes, R"("POSITION":0,"NORMAL":5,"TEXCOORD_0":2,"COLOR_0":3)"),
        place + ".attributes.NORMAL: has values that are none of its accessor's componentType");
}

TEST_CASE("no memory follows from a claim about what Draco has compressed") {
  const auto varint = [](std::uint32_t value) {
    std::string bytes;
    for (; value > 127; value >>= 7U) bytes += static_cast<char>(value | 128U);
    return bytes + static_cast<char>(value);
  };
  constexpr std::uint32_t many = 100'000'000;
  const std::string head = std::string("DRACO\2\2\1", 8);
  const std::string claims[] = {
      head + std::string("\1\0\0\0", 4) + varint(9) + varint(many) + '\0' + varint(1) + varint(0),  // faces
      head + std::string("\1\0\0\0", 4) + varint(many) + varint(9) + '\0' + varint(1) + varint(0),  // vertices
      head + std::string("\1\0\0\0", 4) + varint(9) + varint(9) + '\0' + varint(1) + varint(many),  // more of them
      head + std::string("\0\0\0", 3) + varint(9) + varint(many) + '\1' + std::string(27, '\0')};   // points
  for (const std::string& claim : claims) {
    GltfFile file;
    file.add_view(claim).add_accessor(R"({"type":"VEC3","componentType":5126,"count":4e9})");
    for (int i = 0; i < 3; ++i) file.add_accessor("{}");
    file.add_accessor(R"({"type":"SCALAR","componentType":5125,"count":4e9})");
    const std::string primitives = sheet_primitive(R"("POSITION":0)", R"("POSITION":0)");
    const std::string messages = read_bytes("a.glb", file.glb(draco_scene(primitives))).messages;
    INFO(messages);
    CHECK(contains(messages, "KHR_draco_mesh_compression: claims to be "));
    CHECK(contains(messages, " bytes when it is decoded, too many for a file of "));
  }
}

TEST_CASE("damaged files of Draco are read or refused") {
  const TemporaryFolder folder;
  std::mt19937 random(3);
  std::size_t read = 0, refused = 0;
  for (const auto method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    const std::string good = compressed_sheet(method).glb(draco_scene(sheet_primitive()));
    const std::size_t binary = good.find("BIN") + 4;
    for (int i = 0; i < 400; ++i) {
      std::string damaged = good;
      for (std::size_t edits = 1 + random() % 2; edits > 0; --edits)
        damaged[binary + random() % (damaged.size() - binary)] = static_cast<char>(random());
      ++(is_read_or_refused(folder.file("a.glb"), damaged) ? read : refused);
    }
  }
  CHECK(read > 50);
  CHECK(refused > 100);
}

#else

TEST_CASE("a file of Draco is refused without the library, which the error names") {
  using namespace raytrace::test;
  CHECK(read_bytes("a.gltf", R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"]})")
            .messages ==
        "a.gltf: error: requires extensions that are not read: 'KHR_draco_mesh_compression' (this program was built "
        "without the library Draco)\n");
}

#endif
