#include <filesystem>

#include "import/support.h"
#include "support/catch.h"
#include "support/contains.h"

using namespace raytrace;
using namespace raytrace::test;

namespace {

using Indices = std::vector<std::uint32_t>;
using Floats = std::vector<float>;

/// A pyramid's three faces: values as binary, with a list and an element that no mesh has.
template <class T>
std::string binary_ply(const std::string& type, bool big) {
  std::string text = "ply\nformat binary_";
  text += big ? "big" : "little";
  text += "_endian 1.0\ncomment made by a test\nelement vertex 4\n";
  for (const char* const name : {"x", "y", "z"}) text += "property " + type + " " + name + "\n";
  text += "property list uchar short spare\nelement odd 2\nproperty double what\n";
  text += "element face 3\nproperty uchar flags\nproperty list ushort uint vertex_indices\nend_header\n";
  const int corners[4][3] = {{0, 0, 0}, {10, 0, 0}, {0, 20, 0}, {0, 0, 30}};
  for (int i = 0; i < 4; ++i) {
    for (const int value : corners[i]) text += bytes_of_value(static_cast<T>(value), big);
    text += static_cast<char>(i);
    for (int k = 0; k < i; ++k) text += bytes_of_value(std::int16_t{-1}, big);
  }
  for (int i = 0; i < 2; ++i) text += bytes_of_value(double{7}, big);
  for (std::uint32_t i = 1; i < 4; ++i) {
    text += 'f';
    text += bytes_of_value(std::uint16_t{3}, big);
    for (const std::uint32_t corner : {0U, i, i % 3 + 1}) text += bytes_of_value(corner, big);
  }
  return text;
}

template <class T>
void check_binary(const std::string& type) {
  for (const bool big : {false, true}) {
    const ReadResult read = read_bytes("a.ply", binary_ply<T>(type, big));
    INFO(type << (big ? ", big" : ", little") << " endian\n" << read.messages);
    REQUIRE(read.mesh);
    CHECK(values(read.mesh->positions) == Floats{0, 0, 0, 10, 0, 0, 0, 20, 0, 0, 0, 30});
    CHECK(values(read.mesh->indices) == Indices{0, 1, 2, 0, 2, 3, 0, 3, 1});
    CHECK(read.messages.empty());
  }
}

const std::string square_head =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";

}  // namespace

TEST_CASE("binary PLY files have any type of number in either order") {
  check_binary<std::int8_t>("char");
  check_binary<std::uint8_t>("uint8");
  check_binary<std::int16_t>("short");
  check_binary<std::uint16_t>("ushort");
  check_binary<std::int32_t>("int");
  check_binary<std::uint32_t>("uint32");
  check_binary<float>("float");
  check_binary<double>("float64");
}

TEST_CASE("an ASCII PLY has normals, texture coordinates and colours of its vertices") {
  const ReadResult read = read_bytes(
      "a.ply",
      "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty double x\r\nproperty double y\r\nproperty double z\r\n"
      "property float nx\r\nproperty float ny\r\nproperty float nz\r\nproperty float s\r\nproperty float t\r\n"
      "property uchar red\r\nproperty uchar green\r\nproperty ushort blue\r\nelement face 1\r\n"
      "property list uchar int vertex_index\r\nend_header\r\n"
      "0 0 0 0 0 1 0.25 0.5 255 0 65535\r\n\r\n1e0 +0 0 0 1 0 1 0 0 255 0\r\n-0 1.5 -2.5e-1 1 0 0 0 1 188 0 0\r\n3 0 1 "
      "2\r\n");
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->positions) == Floats{0, 0, 0, 1, 0, 0, 0, 1.5F, -0.25F});
  CHECK(values(read.mesh->normals) == Floats{0, 0, 1, 0, 1, 0, 1, 0, 0});
  CHECK(values(read.mesh->uvs) == Floats{0.25F, 0.5F, 1, 0, 0, 1});
  REQUIRE(read.mesh->colors.size() == 9);
  CHECK(read.mesh->colors[0] == 1);
  CHECK(read.mesh->colors[2] == 1);
  CHECK(read.mesh->colors[6] == Approx(0.502886).epsilon(1e-5));
}

TEST_CASE("a PLY's alphas beside its colours are kept for a scene that asks for them") {
  const auto read = [](const std::string& type, const std::string& alphas, bool for_scene = true,
                       const std::string& colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n") {
    const std::string first = alphas.substr(0, alphas.find(' ')), second = alphas.substr(alphas.find(' ') + 1);
    const std::string color = colors.empty() ? " " : " 1 2 3 ";
    MeshReadSettings settings;
    settings.vertex_alphas = for_scene;
    const ReadResult result = read_bytes(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + colors +
            "property " + type + " alpha\nelement face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0" +
            color + first + "\n1 0 0" + color + second + "\n0 1 0" + color + first + "\n3 0 1 2\n",
        settings);
    INFO(result.messages);
    REQUIRE(result.mesh);
    return values(result.mesh->alphas);
  };
  CHECK(read("uchar", "255 51") == Floats{1, 0.2F, 1});
  CHECK(read("ushort", "0 13107") == Floats{0, 0.2F, 0});
  CHECK(read("float", "0.25 7") == Floats{0.25F, 1, 0.25F});  // none is beyond 0 or 1
  CHECK(read("float", "nan -1") == Floats{0, 0, 0});
  CHECK(read("uchar", "255 255").empty());
  CHECK(read("uchar", "255 51", false).empty());
  CHECK(read("uchar", "255 51", true, "").empty());
}

TEST_CASE("a PLY file's texture is the colour of its mesh, if it is there") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& texture, const std::string& uvs) {
    write_text(folder.file("a.ply"), "ply\nformat ascii 1.0\ncomment VCGLIB generated\ncomment TextureFile " + texture +
                                         "\ncomment TextureFile second.png\nelement vertex 3\nproperty float x\n"
                                         "property float y\nproperty float z\nproperty float " +
                                         uvs +
                                         "\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\n"
                                         "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
    Diagnostics diagnostics(folder.file("a.ply"));
    ReadResult result{read_mesh(folder.file("a.ply"), {}, diagnostics), ""};
    result.messages = printed(diagnostics, folder.path().string());
    REQUIRE(result.mesh);
    return result;
  };
  std::filesystem::create_directory(folder.file("scans"));
  write_text(folder.file("scans/a wall.png"), "of which nobody reads a byte");
  const ReadResult textured = read("scans\\a wall.png", "s");
  const std::string several =
      "a.ply: warning: names 2 textures, and faces do not say which they have: all have the first\n";
  CHECK(textured.messages == several);
  REQUIRE(textured.mesh->materials.size() == 1);
  CHECK(textured.mesh->materials[0].map_kd.file == "scans/a wall.png");
  CHECK(textured.mesh->uvs.size() == 6);
  const ReadResult missing = read("floor.png", "s");
  CHECK(missing.mesh->materials.empty());
  CHECK(missing.messages == several + "a.ply: warning: the texture 'floor.png' is left out: there is no such file\n");
  const ReadResult unplaced = read("scans/a wall.png", "other");
  CHECK(unplaced.mesh->materials.empty());
  CHECK(unplaced.messages ==
        several + "a.ply: warning: the texture 'scans/a wall.png' is left out: there are no texture coordinates\n");
}

TEST_CASE("colours of faces are left out with a warning") {
  const ReadResult read = read_bytes(
      "a.ply", square_head +
                   "element face 1\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
                   "property uchar blue\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n");
  REQUIRE(read.mesh);
  CHECK(read.mesh->colors.empty());
  CHECK(contains(read.messages,
                 "warning: the colours of its faces ('red', 'green', 'blue' of the element 'face') are "
                 "left out: only vertices have colours here"));
}

TEST_CASE("a PLY file of points alone, as a mesh, is a cloud's") {
  CHECK(contains(read_bytes("a.ply", square_head + "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n").messages,
                 "points alone are for the <spherecloud> of a scene"));
}

TEST_CASE("quads stay quads where they are at least half of the faces") {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const std::string list = "property list uchar int vertex_indices\nend_header\n";
  const ReadResult quads =
      read_bytes("a.ply", square_head + "element face 2\n" + list + vertices + "4 0 1 2 3\n3 0 1 2\n");
  REQUIRE(quads.mesh);
  CHECK(quads.mesh->corners == 4);
  CHECK(values(quads.mesh->indices) == Indices{0, 1, 2, 3, 0, 1, 2, 2});
  const ReadResult triangles =
      read_bytes("a.ply", square_head + "element face 3\n" + list + vertices + "4 0 1 2 3\n3 0 1 2\n3 0 2 3\n");
  REQUIRE(triangles.mesh);
  CHECK(triangles.mesh->corners == 3);
  CHECK(values(triangles.mesh->indices) == Indices{0, 1, 3, 2, 3, 1, 0, 1, 2, 0, 2, 3});
}

TEST_CASE("what a PLY file claims and does not have is an error with its place") {
  const std::string list = "property list uchar int vertex_indices\nend_header\n";
  const std::string claim =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000000\nproperty float x\n"
      "property float y\nproperty float z\nelement face 4000000000\n" +
      list;
  CHECK(contains(read_bytes("a.ply", claim).messages, "more than 4294967294 vertices"));
  std::string smaller = claim;
  smaller.replace(smaller.find("1000000000000"), 13, "4000000000");
  CHECK(read_bytes("a.ply", smaller + std::string(24, '\0')).messages ==
        "a.ply: error: byte " + std::to_string(smaller.size()) +
            ": the file ends after 2 of the 4000000000 elements 'vertex' that its head announces\n");
  CHECK(
      read_bytes("a.ply", square_head + "element face 1\n" + list + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 4\n").messages ==
      "a.ply:14: error: an index is not that of one of the 4 vertices\n");
  CHECK(read_bytes("a.ply", square_head + "element face 1\n" + list + "0 0 0\n1 x 0\n1 1\n0 1 0\n3 0 1 2\n").messages ==
        "a.ply:11: error: 'y' is 'x', which is no number\na.ply:12: error: 'z' is missing\n");
  CHECK(read_bytes("a.ply", "ply\nformat ascii 1.0\nelement vertex many\n").messages ==
        "a.ply:3: error: an element needs a name and how many there are, such as: element vertex 8\n");
}

TEST_CASE("faces at vertices that are not finite, and faces without area, are left out with a warning") {
  const std::string list = "property list uchar int vertex_indices\nend_header\n";
  const ReadResult read =
      read_bytes("a.ply", square_head + "element face 5\n" + list +
                              "0 0 0\n1 0 0\nnan 1 0\n0 1 0\n3 0 1 2\n3 0 1 3\n3 1 1 0\n2 0 1\n3 2 3 0\n");
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->indices) == Indices{0, 1, 3});
  CHECK(read.mesh->positions[6] == 0);
  CHECK(read.messages ==
        "a.ply: warning: 1 vertices are not finite or beyond 1e18; 2 faces at them are left out\n"
        "a.ply: warning: 2 faces have less than three different corners and are left out\n");
}

TEST_CASE("an origin is subtracted before positions are rounded") {
  MeshReadSettings settings;
  settings.origin = {1e8, 0, 0};
  const ReadResult read = read_bytes("a.ply",
                                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                                     "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
                                     "end_header\n100000000.125 0 0\n100000001 0 0\n100000000 1 0\n3 0 1 2\n",
                                     settings);
  REQUIRE(read.mesh);
  CHECK(read.mesh->positions[0] == 0.125F);
}

TEST_CASE("a polygon with dents is cut into triangles that do not leave it") {
  // An L of area 3.
  const ReadResult read = read_bytes("a.ply",
                                     "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                                     "end_header\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n6 2 3 4 5 0 1\n");
  REQUIRE(read.mesh);
  REQUIRE(read.mesh->face_count() == 4);
  float area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = [&](std::size_t k, std::size_t axis) {
      return read.mesh->positions[3 * read.mesh->indices[3 * i + k] + axis];
    };
    const float twice = (at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) - (at(1, 1) - at(0, 1)) * (at(2, 0) - at(0, 0));
    CHECK(twice > 0);
    area += twice / 2;
  }
  CHECK(area == 3);
}

TEST_CASE("a PLY file of points has their radii and colours") {
  const TemporaryFolder folder;
  write_text(folder.file("a.ply"),
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "property float radius\nproperty float red\nproperty float green\nproperty float blue\nend_header\n"
             "0 1 2 0.5 1 0.5 0\n3 4 5 -1 0 0 0\n6 7 8 2 0 0.25 1\n");
  Diagnostics diagnostics("a.ply");
  const auto cloud = read_point_cloud(folder.file("a.ply"), {}, diagnostics);
  REQUIRE(cloud);
  CHECK(values(cloud->positions) == Floats{0, 1, 2, 6, 7, 8});
  CHECK(values(cloud->radii) == Floats{0.5F, 2});
  CHECK(values(cloud->colors) == Floats{1, 0.5F, 0, 0, 0.25F, 1});
  CHECK(diagnostics.warning_count() == 1);
}
