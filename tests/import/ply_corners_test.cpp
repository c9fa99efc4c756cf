// PLY: what faces have beside their vertices: texture coordinates of corners, and which texture it is.
#include <array>
#include <string>
#include <vector>

#include "import/support.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

using CornerUvs = std::vector<std::array<float, 2>>;

struct PlyFace {
  std::vector<int> vertices;
  std::vector<float> texcoord;
  int texnumber = 0;
};

enum class PlyForm { text, little_endian, big_endian };

std::string ply_of(PlyForm form, const std::vector<PlyFace>& faces, bool uvs_first = false,
                   const std::string& comments = "") {
  const std::string names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  const std::string lists[] = {"property list uchar int vertex_indices\n", "property list uchar float texcoord\n"};
  std::string bytes = "ply\nformat " + names[static_cast<std::size_t>(form)] + " 1.0\n" + comments +
                      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                      "property uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float nx\nproperty "
                      "float ny\nproperty float nz\n"
                      "element face " +
                      std::to_string(faces.size()) + "\n" + lists[uvs_first ? 1 : 0] + lists[uvs_first ? 0 : 1] +
                      "property int texnumber\nend_header\n";
  const auto put = [&](auto value, const char* behind = " ") {
    bytes +=
        form == PlyForm::text ? std::to_string(value) + behind : bytes_of_value(value, form == PlyForm::big_endian);
  };
  for (int i = 0; i < 4; ++i) {
    const bool right = i == 1 || i == 2, upper = i >= 2;
    for (const float value : {right ? 1.0F : 0.0F, upper ? 1.0F : 0.0F, 0.0F}) put(value);
    for (const int color : {i == 1 ? 255 : 0, 0, 255, 51 * i}) put(static_cast<std::uint8_t>(color));
    put(0.0F);
    put(right ? 1.0F : 0.0F);
    put(1.0F, "\n");
  }
  for (const PlyFace& face : faces) {
    for (const bool of_uvs : {uvs_first, !uvs_first}) {
      put(static_cast<std::uint8_t>(of_uvs ? face.texcoord.size() : face.vertices.size()));
      if (of_uvs)
        for (const float value : face.texcoord) put(value);
      else
        for (const int vertex : face.vertices) put(vertex);
    }
    put(face.texnumber, "\n");
  }
  return bytes;
}

/// Of the corners of a mesh's faces.
CornerUvs uvs_of(const MeshData& mesh) {
  CornerUvs uvs;
  for (const std::uint32_t vertex : mesh.indices) uvs.push_back({mesh.uvs[2 * vertex], mesh.uvs[2 * vertex + 1]});
  return uvs;
}

constexpr PlyForm all_forms[] = {PlyForm::text, PlyForm::little_endian, PlyForm::big_endian};

}  // namespace

TEST_CASE("texture coordinates of a PLY file's corners make vertices of their own") {
  MeshReadSettings settings;
  settings.vertex_alphas = true;
  for (const PlyForm form : all_forms)
    for (const bool uvs_first : {false, true}) {
      const ReadResult read = read_bytes(
          "a.ply", ply_of(form, {{{0, 1, 2}, {0, 0, 1, 0, 1, 1}}, {{0, 2, 3}, {0, 0, 0.25F, 0.5F, 0, 1}}}, uvs_first),
          settings);
      INFO(read.messages << static_cast<int>(form) << uvs_first);
      CHECK(read.messages.empty());
      REQUIRE(read.mesh);
      CHECK(uvs_of(*read.mesh) == CornerUvs{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {0.25F, 0.5F}, {0, 1}});
      // Vertex 0 has the same in both faces, and vertex 2 others.
      CHECK(values(read.mesh->indices) == std::vector<std::uint32_t>{0, 1, 2, 0, 3, 4});
      CHECK(values(read.mesh->positions) == std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0});
      CHECK(read.mesh->colors[3] == 1);
      CHECK(read.mesh->colors[9] == 0);
      CHECK(values(read.mesh->alphas) == std::vector<float>{0, 0.2F, 0.4F, 0.4F, 0.6F});
      CHECK(read.mesh->normals[3 * 3 + 1] == 1);
      CHECK(read.mesh->normals[3 * 4 + 1] == 0);
    }
}

TEST_CASE("texture coordinates of the corners of polygons go with them when they are cut") {
  for (const PlyForm form : all_forms) {
    const ReadResult quads = read_bytes("a.ply", ply_of(form, {{{0, 1, 2, 3}, {0, 0, 1, 0, 1, 1, 0, 1}}}));
    REQUIRE(quads.mesh);
    CHECK(quads.mesh->corners == 4);
    CHECK(uvs_of(*quads.mesh) == CornerUvs{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    const ReadResult mixed = read_bytes("a.ply", ply_of(form, {{{0, 1, 2}, {0, 0, 2, 0, 2, 2}},
                                                               {{0, 1, 2}, {0, 0, 2, 0, 2, 2}},
                                                               {{0, 2, 3}, {}},
                                                               {{0, 1, 2, 3}, {0, 0, 1, 0, 1, 1, 0, 1}}}));
    REQUIRE(mixed.mesh);
    CHECK(mixed.mesh->corners == 3);
    CHECK(mixed.mesh->face_count() == 5);
    const CornerUvs uvs = uvs_of(*mixed.mesh);
    CHECK(uvs[5] == std::array{2.0F, 2.0F});
    CHECK(uvs[7] == std::array{0.0F, 0.0F});
    // Two triangles that meet between the second corner and the fourth.
    CHECK(CornerUvs(uvs.begin() + 9, uvs.end()) == CornerUvs{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 1}, {1, 0}});
    CHECK(contains(mixed.messages, "1 faces have not two numbers 'texcoord' for each corner, which are 0 0 then"));
  }
}

TEST_CASE("the faces of a PLY file with several textures have those of their numbers") {
  const TemporaryFolder folder;
  write_text(folder.file("a.png"), "of which nobody reads a byte");
  write_text(folder.file("c.png"), "nor of this");
  const std::vector<PlyFace> faces{{{0, 1, 2}, {0, 0, 1, 0, 1, 1}, 2}, {{0, 2, 3}, {0, 0, 1, 1, 0, 1}, 0},
                                   {{0, 2, 2}, {0, 0, 1, 1, 1, 1}, 1}, {{0, 1, 3}, {0, 0, 1, 0, 0, 1}, -1},
                                   {{0, 1, 3}, {0, 0, 1, 0, 0, 1}, 3}, {{0, 1, 3}, {0, 0, 1, 0, 0, 1}, 1}};
  for (const PlyForm form : all_forms) {
    write_text(folder.file("a.ply"), ply_of(form, faces, false,
                                            "comment TextureFile a.png\ncomment TextureFile b.png\n"
                                            "comment TextureFile c.png\n"));
    Diagnostics diagnostics(folder.file("a.ply"));
    const auto mesh = read_mesh(folder.file("a.ply"), {}, diagnostics);
    REQUIRE(mesh);
    REQUIRE(mesh->materials.size() == 3);
    CHECK(mesh->materials[0].map_kd.file == "a.png");
    CHECK(mesh->materials[1].map_kd.file.empty());
    CHECK(mesh->materials[2].map_kd.file == "c.png");
    constexpr std::uint32_t none = MeshData::no_material;
    CHECK(values(mesh->face_materials) == std::vector<std::uint32_t>{2, 0, none, none, 1});
    CHECK(contains(printed(diagnostics, folder.path().string()),
                   "the texture 'b.png' is left out: there is no such file"));
  }
}

TEST_CASE("a value of a corner that is none is an error in its line") {
  std::string text = ply_of(PlyForm::text, {{{0, 1, 2}, {0, 0, 1, 0, 1, 1}}});
  text.replace(text.rfind("1.0"), 3, "one");
  CHECK(contains(read_bytes("a.ply", text).messages, "'texcoord' has a value that is missing or wrong"));
}

}  // namespace raytrace::test
