#include <zlib.h>

#include <filesystem>
#include <random>

#include "import/support.h"
#include "support/catch.h"
#include "support/contains.h"

using namespace raytrace;
using namespace raytrace::test;

namespace {

using Indices = std::vector<std::uint32_t>;

std::string binary_stl(const std::string& head, std::uint32_t claimed, const std::vector<float>& corners) {
  std::string bytes = head;
  bytes.resize(80);
  bytes += bytes_of_value(claimed);
  for (std::size_t i = 0; i < corners.size(); i += 9) {
    bytes += std::string(12, '\0');
    for (std::size_t k = 0; k < 9; ++k) bytes += bytes_of_value(corners[i + k]);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

const std::vector<float> two_facets = {0, 0, 0, 1, 0, 0, 1, 1, 0, -0.F, 0, 0, 1, 1, 0, 0, 1, 0};
const std::string text_stl =
    "solid a\n facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n VERTEX 1 1 0\n endloop\n endfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

std::string compressed(const std::string& bytes) {
  const TemporaryFolder folder;
  const gzFile file = gzopen(folder.file("x.gz").c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return bytes_of(folder.file("x.gz"));
}

/// A wavy grid, large enough for many chunks.
std::string grid_obj(int edge) {
  std::string text;
  for (int i = 0; i < edge * edge; ++i)
    text += "v " + std::to_string(i % edge) + ".25 " + std::to_string(i / edge) + " 0.5\nvt 0." +
            std::to_string(i % 7) + " 0\n";
  for (int i = 0; i + edge + 1 < edge * edge; ++i) {
    const auto corner = [&](int v) {
      return std::to_string(v + 1) + "/" + std::to_string(v * 31 % (edge * edge) + 1) + " ";
    };
    text += "f " + corner(i) + corner(i + 1) + corner(i + edge) + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("STL files are read alike, and corners at one position become one vertex") {
  for (const std::string& bytes : {text_stl, binary_stl("made", 2, two_facets), binary_stl("solid", 2, two_facets)}) {
    const ReadResult read = read_bytes("a.stl", bytes);
    INFO(read.messages);
    REQUIRE(read.mesh);
    CHECK(values(read.mesh->indices) == Indices{0, 1, 2, 0, 2, 3});
    CHECK(values(read.mesh->positions) == std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    CHECK(read.messages.empty());
    MeshReadSettings settings;
    settings.weld = false;
    CHECK(read_bytes("a.stl", bytes, settings).mesh->vertex_count() == 6);
  }
}

TEST_CASE("what is wrong in an STL file is an error with its place") {
  CHECK(read_bytes("a.stl", binary_stl("made", 4000000000, two_facets)).messages ==
        "a.stl: error: byte 80: claims 4000000000 facets, and has room for 2\n");
  CHECK(contains(read_bytes("a.stl", binary_stl("made", 2, two_facets) + "more").messages,
                 "warning: byte 184: 4 bytes behind the last facet are not read"));
  CHECK(read_bytes("a.stl", "solid\nfacet\nouter loop\nvertex 1 2\nendloop\nwhat\n").messages ==
        "a.stl:4: error: a vertex needs three numbers\na.stl:5: error: a facet with other than three vertices, here or "
        "before\n"
        "a.stl:6: error: unknown word 'what' in an STL file\n");
}

TEST_CASE("files may be compressed") {
  const ReadResult plain = read_bytes("a.stl", text_stl);
  const ReadResult read = read_bytes("a.stl.gz", compressed(text_stl.substr(0, 50)) + compressed(text_stl.substr(50)));
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(same_mesh(*read.mesh, *plain.mesh));
  const std::string whole = compressed(text_stl);
  CHECK(contains(read_bytes("a.stl.gz", whole.substr(0, whole.size() / 2)).messages,
                 "the compressed data ends too early"));
  CHECK(contains(read_bytes("a.stl.gz", text_stl).messages, "the compressed data is damaged (incorrect header check)"));
}

TEST_CASE("a file that is missing, a folder or no mesh is an error") {
  Diagnostics missing("a.ply"), folder("b.ply"), other("c.txt");
  const TemporaryFolder in;
  std::filesystem::create_directory(in.file("b.ply"));
  CHECK_FALSE(read_mesh(in.file("a.ply"), {}, missing));
  CHECK(missing.error_count() == 1);
  CHECK_FALSE(read_mesh(in.file("b.ply"), {}, folder));
  CHECK(contains(folder.kept().at(0).message, "it is a folder"));
  CHECK_FALSE(read_mesh("c.txt", {}, other));
  CHECK(other.error_count() == 1);
}

TEST_CASE("meshes do not depend on the number of threads") {
  const std::string text = grid_obj(150);
  MeshReadSettings one, many;
  one.threads = 1;
  many.threads = 4;
  const ReadResult a = read_bytes("a.obj", text, one), b = read_bytes("a.obj", text, many);
  REQUIRE(a.mesh);
  REQUIRE(b.mesh);
  CHECK(a.mesh->vertex_count() > 150 * 150 - 2);
  CHECK(same_mesh(*a.mesh, *b.mesh));
}

TEST_CASE("damaged files are read or refused") {
  const std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n" +
      std::string(45, '\x01') + std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0\4\0\0\0\0\1\0\0\0\2\0\0\0\1\0\0\0", 30);
  const std::string text_ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n5 0 1 2 1 0\n";
  const std::string obj =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0 1 1 1\nv 1 1 0\nvt 0 1\nvn 0 0 1\nusemtl a\nf 1/1/1 2 3\nf -1 -2 -3 -1 -2\n";
  const std::pair<std::string, std::string> files[] = {
      {"a.ply", ply},      {"a.ply", text_ply},           {"a.obj", obj}, {"a.stl", binary_stl("x", 2, two_facets)},
      {"a.stl", text_stl}, {"a.ply.gz", compressed(ply)}, {"a.mtl", ""}};
  const TemporaryFolder folder;
  std::mt19937 random(1);
  std::size_t good = 0, refused = 0;
  for (const auto& [name, bytes] : files)
    for (int i = 0; i < 1500 && !bytes.empty(); ++i) {
      std::string damaged = bytes;
      for (std::size_t edits = 1 + random() % 4; edits > 0 && !damaged.empty(); --edits) {
        const std::size_t at = random() % damaged.size();
        switch (random() % 5) {
          case 0:
            damaged[at] = static_cast<char>(random());
            break;
          case 1:
            damaged.erase(at, 1 + random() % 8);
            break;
          case 2:
            damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 16));
            break;
          case 3:
            damaged[at] = "0123456789-.e/ \n"[random() % 16];
            break;
          default:
            damaged[at] = "\xff\x7f\x80\0"[random() % 4];
        }
      }
      ++(is_read_or_refused(folder.file(name), damaged) ? good : refused);
    }
  CHECK(good > 100);
  CHECK(refused > 100);
}
