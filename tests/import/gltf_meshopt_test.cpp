// glTF files with buffer views that meshoptimizer has compressed.
#include "import/support.h"
#include "support/contains.h"
#include "support/gltf.h"

#if defined(RAYTRACE_MESHOPTIMIZER)

#include <meshoptimizer.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

using namespace raytrace;
using namespace raytrace::test;

namespace {

constexpr std::uint32_t columns = 20, rows = 15;
constexpr std::size_t grid_size = columns * rows;

std::vector<float> grid_positions() {
  std::vector<float> positions;
  for (std::size_t i = 0; i < grid_size; ++i)
    for (const std::size_t k : {i % columns, i / columns, i * i % 7}) positions.push_back(static_cast<float>(k) / 8);
  return positions;
}

std::vector<std::uint32_t> grid_corners() {
  std::vector<std::uint32_t> corners;
  for (std::uint32_t y = 0; y + 1 < rows; ++y)
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t first = y * columns + x, above = first + columns;
      for (const std::uint32_t corner : {first, first + 1, above + 1, first, above + 1, above})
        corners.push_back(corner);
    }
  return corners;
}

/// The encoder begins a face with any of its corners.
std::vector<std::array<std::uint32_t, 3>> faces_from_least(const std::vector<std::uint32_t>& corners) {
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    std::array<std::uint32_t, 3> face{corners[i], corners[i + 1], corners[i + 2]};
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(face);
  }
  return faces;
}

template <class T>
std::string encoded_vertices(const std::vector<T>& values, std::size_t stride) {
  const std::size_t count = values.size() * sizeof(T) / stride;
  std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
  auto* const to = reinterpret_cast<unsigned char*>(bytes.data());
  bytes.resize(meshopt_encodeVertexBuffer(to, bytes.size(), values.data(), count, stride));
  return bytes;
}

/// encode: as triangles, or as a sequence.
using IndexEncoder = std::size_t (*)(unsigned char*, std::size_t, const unsigned int*, std::size_t);
std::string encoded_indices(const std::vector<std::uint32_t>& indices, IndexEncoder encode) {
  meshopt_encodeIndexVersion(1);  // the extension's
  std::string bytes(8 * indices.size() + 64, '\0');
  auto* const to = reinterpret_cast<unsigned char*>(bytes.data());
  bytes.resize(encode(to, bytes.size(), indices.data(), indices.size()));
  return bytes;
}

std::string accessor_of(std::size_t view, const std::string& type, int component_type, std::size_t count) {
  return "{\"bufferView\":" + std::to_string(view) + ",\"type\":\"" + type +
         "\",\"componentType\":" + std::to_string(component_type) + ",\"count\":" + std::to_string(count) +
         (component_type == 5126 || type == "SCALAR" ? "}" : ",\"normalized\":true}");
}

/// Accessors 0, the positions, and 1, the corners.
GltfFile compressed_grid(const std::string& extension = "EXT_meshopt_compression") {
  const std::vector<std::uint32_t> corners = grid_corners();
  GltfFile file;
  file.add_compressed_view(encoded_vertices(grid_positions(), 12), grid_size, 12, "ATTRIBUTES", "NONE", extension);
  file.add_compressed_view(encoded_indices(corners, meshopt_encodeIndexBuffer), corners.size(), 2, "TRIANGLES", "NONE",
                           extension);
  file.add_accessor(accessor_of(0, "VEC3", 5126, grid_size));
  file.add_accessor(accessor_of(1, "SCALAR", 5123, corners.size()));
  return file;
}

std::string requiring(const std::string& extension, const std::string& primitive, const std::string& of_node = "") {
  return "\"extensionsRequired\":[\"" + extension + R"("],"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + of_node +
         R"(}],"meshes":[{"primitives":[{)" + primitive + "}]}]";
}
const std::string of_grid = R"("attributes":{"POSITION":0},"indices":1)";

MeshData read_compressed(const GltfFile& file, const std::string& primitive = of_grid, const std::string& of_node = "",
                         const std::string& extension = "EXT_meshopt_compression") {
  MeshReadSettings settings;
  settings.vertex_alphas = true;
  ReadResult read = read_bytes("a.glb", file.glb(requiring(extension, primitive, of_node)), settings);
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(read.messages.empty());
  return std::move(*read.mesh);
}

/// View and accessor 2 of filtered values, four to each element.
template <class T>
GltfFile with_filtered(const std::vector<T>& filtered, const std::string& filter, const std::string& type,
                       int component_type) {
  GltfFile file = compressed_grid();
  const std::size_t count = filtered.size() / 4;
  file.add_compressed_view(encoded_vertices(filtered, 4 * sizeof(T)), count, 4 * sizeof(T), "ATTRIBUTES", filter);
  return file.add_accessor(accessor_of(2, type, component_type, count));
}

/// Later versions of the library ask for a mode as well.
template <class... Mode>
void encode_exponents(void (*encode)(void*, std::size_t, std::size_t, int, const float*, Mode...),
                      const std::vector<float>& numbers, std::vector<std::uint32_t>& encoded) {
  encode(encoded.data(), numbers.size(), sizeof(float), 24, numbers.data(), Mode{}...);
}

}  // namespace

TEST_CASE("meshoptimizer's attributes and triangles are as they were before") {
  for (const std::string extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const MeshData mesh = read_compressed(compressed_grid(extension), of_grid, "", extension);
    CHECK(values(mesh.positions) == grid_positions());
    CHECK(faces_from_least(values(mesh.indices)) == faces_from_least(grid_corners()));
  }
}

TEST_CASE("meshoptimizer's indices are as they were before") {
  std::vector<std::uint32_t> strip;
  for (std::uint32_t x = 0; x < columns; ++x)
    for (const std::uint32_t corner : {x, x + columns}) strip.push_back(corner);
  const std::string of_strip = R"("attributes":{"POSITION":0},"indices":2,"mode":5)";
  const MeshData plain = read_compressed(compressed_grid().add(strip, "SCALAR", 5125, strip.size()), of_strip);
  CHECK(plain.face_count() == strip.size() - 2);
  for (const std::size_t stride : {2U, 4U}) {
    GltfFile file = compressed_grid();
    file.add_compressed_view(encoded_indices(strip, meshopt_encodeIndexSequence), strip.size(), stride, "INDICES");
    file.add_accessor(accessor_of(2, "SCALAR", stride == 2 ? 5123 : 5125, strip.size()));
    CHECK(values(read_compressed(file, of_strip).indices) == values(plain.indices));
  }
}

TEST_CASE("meshoptimizer's octahedra become unit normals") {
  std::mt19937 random(7);
  std::vector<float> normals;
  for (std::size_t i = 0; i < grid_size; ++i) {
    std::array<float, 3> n{};
    for (float& value : n) value = static_cast<float>(random() % 2001) / 1000 - 1;
    for (const float value : n) normals.push_back(value / std::hypot(n[0], n[1], n[2]));
    normals.push_back(0);
  }
  const auto check = [&]<class T>(T, int component_type, int bits, double tolerance) {
    std::vector<T> filtered(4 * grid_size);
    meshopt_encodeFilterOct(filtered.data(), grid_size, 4 * sizeof(T), bits, normals.data());
    const MeshData mesh = read_compressed(with_filtered(filtered, "OCTAHEDRAL", "VEC3", component_type),
                                          R"("attributes":{"POSITION":0,"NORMAL":2},"indices":1)");
    meshopt_decodeFilterOct(filtered.data(), grid_size, 4 * sizeof(T));
    REQUIRE(mesh.normals.size() == 3 * grid_size);
    double error = 0, from_library = 0;
    for (std::size_t i = 0; i < 3 * grid_size; ++i) {
      const std::size_t at = i / 3 * 4 + i % 3;
      error = std::max(error, std::abs(double{mesh.normals[i]} - double{normals[at]}));
      const double of_library = filtered[at] / double{std::numeric_limits<T>::max()};
      from_library = std::max(from_library, std::abs(mesh.normals[i] - of_library));
    }
    CHECK(error < tolerance);
    CHECK(from_library < 1.01 / double{std::numeric_limits<T>::max()});
  };
  check(std::int8_t{}, 5120, 8, 0.02);
  check(std::int16_t{}, 5122, 12, 0.0015);
}

TEST_CASE("meshoptimizer's quaternions turn instances") {
  constexpr float half = 0.70710678F;
  const std::vector<float> turns{0, 0, half, half, 0, half, 0, -half, 1, 0, 0, 0, 0.5F, -0.5F, 0.5F, 0.5F};
  std::vector<std::int16_t> filtered(turns.size());
  meshopt_encodeFilterQuat(filtered.data(), 4, 8, 16, turns.data());
  const MeshData mesh = read_compressed(with_filtered(filtered, "QUATERNION", "VEC4", 5122), of_grid,
                                        R"(,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"ROTATION":2}}})");
  REQUIRE(mesh.vertex_count() == 4 * grid_size);
  const std::vector<float> before = grid_positions();
  double error = 0;
  for (std::size_t i = 0; i < grid_size; ++i) {
    const double x = before[3 * i], y = before[3 * i + 1], z = before[3 * i + 2];
    // A quarter about z, one back about y, a half about x, and a third about (1, -1, 1).
    const Vec3d turned[] = {{-y, x, z}, {-z, y, x}, {x, -y, -z}, {-y, -z, x}};
    for (std::size_t k = 0; k < 4; ++k) {
      const float* const is = &mesh.positions[3 * (k * grid_size + i)];
      error = std::max(error, length(Vec3d(is[0], is[1], is[2]) - turned[k]));
    }
  }
  CHECK(error < 0.001);
}

TEST_CASE("meshoptimizer's numbers with exponents are exact") {
  std::vector<float> numbers;
  for (std::size_t i = 0; i < grid_size; ++i)
    for (const double value : {0.1, -7.7, 1e-20, 3e17})
      numbers.push_back(static_cast<float>(value * static_cast<double>(i + 1) / grid_size));
  std::vector<std::uint32_t> filtered(numbers.size());
  encode_exponents(meshopt_encodeFilterExp, numbers, filtered);
  const MeshData mesh = read_compressed(with_filtered(filtered, "EXPONENTIAL", "VEC3", 5126),
                                        R"("attributes":{"POSITION":2},"indices":1)");
  meshopt_decodeFilterExp(filtered.data(), grid_size, 16);
  REQUIRE(mesh.vertex_count() == grid_size);
  std::size_t different = 0;
  double error = 0;
  for (std::size_t i = 0; i < 3 * grid_size; ++i) {
    const std::size_t at = i / 3 * 4 + i % 3;
    if (mesh.positions[i] != std::bit_cast<float>(filtered[at])) ++different;
    error = std::max(error, std::abs(double{mesh.positions[i]} / double{numbers[at]} - 1));
  }
  CHECK(different == 0);
  CHECK(error < 1e-6);
}

TEST_CASE("meshoptimizer's colours are restored from luma and two differences") {
  const auto check = [&]<class T>(T, int component_type) {
    // With k bits: luma, orange, green, and alpha below its first bit.
    std::vector<T> filtered;
    const auto add = [&](int bits, int red, int green, int blue, int alpha) {
      filtered.push_back(static_cast<T>((red + 2 * green + blue) / 4));
      filtered.push_back(static_cast<T>((red - blue) / 2));
      filtered.push_back(static_cast<T>((2 * green - red - blue) / 4));
      filtered.push_back(static_cast<T>(1 << (bits - 1) | alpha));
    };
    for (std::size_t i = 0; i < grid_size; i += 3) {
      add(8, 255, 3, 55, 127);
      add(6, 0, 62, 40, 0);
      add(8, 20, 200, 60, 64);
    }
    const MeshData mesh = read_compressed(with_filtered(filtered, "COLOR", "VEC4", component_type),
                                          R"("attributes":{"POSITION":0,"COLOR_0":2},"indices":1)");
    REQUIRE(mesh.colors.size() == 3 * grid_size);
    const double expected[] = {255 / 255.0, 3 / 255.0,  55 / 255.0,  0,         62 / 63.0,
                               40 / 63.0,   20 / 255.0, 200 / 255.0, 60 / 255.0};
    double error = 0;
    for (std::size_t i = 0; i < mesh.colors.size(); ++i)
      error = std::max(error, std::abs(double{mesh.colors[i]} - expected[i % 9]));
    // Of 8, 6 and 8 bits; the first says how many, and those below it are alpha's.
    const double alphas[] = {1, 0, 128 / 255.0};
    REQUIRE(mesh.alphas.size() == grid_size);
    for (std::size_t i = 0; i < mesh.alphas.size(); ++i)
      error = std::max(error, std::abs(double{mesh.alphas[i]} - alphas[i % 3]) / 2);
    CHECK(error < 0.51 / double{std::numeric_limits<T>::max()});
  };
  check(std::uint8_t{}, 5121);
  check(std::uint16_t{}, 5123);
}

TEST_CASE("what is wrong in a view that meshoptimizer has compressed is an error with its place") {
  const std::string good = compressed_grid().glb(requiring("EXT_meshopt_compression", of_grid));
  const auto message = [&](const std::string& what, const std::string& by) {
    std::string bytes = good;
    const std::size_t at = bytes.find(what);
    REQUIRE(at != std::string::npos);
    REQUIRE(by.size() <= what.size());
    return read_bytes("a.glb", bytes.replace(at, what.size(), by + std::string(what.size() - by.size(), ' '))).messages;
  };
  const std::string place = "a.glb: error: bufferViews[0].extensions.EXT_meshopt_compression";
  const std::string in_triangles = "a.glb: error: bufferViews[1].extensions.EXT_meshopt_compression";
  CHECK(contains(message("ATTRIBUTES", "TRIANGLES\""), "is no glTF"));
  CHECK(contains(message(R"("ATTRIBUTES")", R"("INDICES")"), place + ".byteStride: is neither 2 nor 4"));
  CHECK(
      contains(message(R"("ATTRIBUTES")", R"("POINTS")"), place + ".mode: is none of ATTRIBUTES, TRIANGLES, INDICES"));
  CHECK(contains(message(R"("filter":"NONE")", R"("filter":"")"), place + ".filter: is none of NONE, OCTAHEDRAL, "));
  CHECK(contains(message(R"("NONE","count":300)", R"("COLOR","count":1)"), place + ".byteStride: is neither 4 nor 8"));
  CHECK(contains(message(R"("count":300)", R"("count":299)"),
                 "a.glb: error: bufferViews[0]: its byteLength is not 299 times 12, as it has where it is compressed"));
  CHECK(contains(message(R"("count":300)", R"("count":3e9)"), "its byteLength is not 3000000000 times 12"));
  CHECK(contains(message(R"("count":1596)", R"("count":1597)"), in_triangles + ".count: is no multiple of 3"));
  CHECK(contains(message("\xa0", "\xa1"), place + ": its data is damaged, or of a kind that meshoptimizer 0."));
  CHECK(contains(message("\xe1", "\xe7"), in_triangles + ": its data is damaged"));
}

TEST_CASE("no memory follows from a claim about what meshoptimizer has compressed") {
  GltfFile file;
  file.add_compressed_view(std::string(100, '\xa0'), 100'000'000, 12, "ATTRIBUTES");
  file.add_accessor(accessor_of(0, "VEC3", 5126, 100'000'000));
  const std::string text = file.glb(requiring("EXT_meshopt_compression", R"("attributes":{"POSITION":0})"));
  CHECK(read_bytes("a.glb", text).messages ==
        "a.glb: error: bufferViews[0].extensions.EXT_meshopt_compression: claims to be 1200000000 bytes when it is "
        "decoded, too many for a file of " +
            std::to_string(text.size()) + "\n");
}

TEST_CASE("damaged files of meshoptimizer are read or refused") {
  std::vector<std::int8_t> normals(4 * grid_size, 127);
  const std::string good =
      with_filtered(normals, "OCTAHEDRAL", "VEC3", 5120)
          .glb(requiring("EXT_meshopt_compression", R"("attributes":{"POSITION":0,"NORMAL":2},"indices":1)"));
  const std::size_t binary = good.find("BIN");
  const TemporaryFolder folder;
  std::mt19937 random(2);
  std::size_t read = 0, refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string damaged = good;
    for (std::size_t edits = 1 + random() % 3; edits > 0; --edits)
      damaged[binary + 4 + random() % (damaged.size() - binary - 4)] = static_cast<char>(random());
    ++(is_read_or_refused(folder.file("a.glb"), damaged) ? read : refused);
  }
  CHECK(read > 20);
  CHECK(refused > 100);
}

#else

TEST_CASE("a file of meshoptimizer is refused without the library, which the error names") {
  using namespace raytrace::test;
  CHECK(
      read_bytes("a.gltf", R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"]})")
          .messages ==
      "a.gltf: error: requires extensions that are not read: 'EXT_meshopt_compression' (this program was built without "
      "the library meshoptimizer)\n");
}

#endif
