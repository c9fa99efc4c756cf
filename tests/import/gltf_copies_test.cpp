// glTF: meshes at very many places, which are kept once.
#include "support/gltf_copies.h"

#include <limits>

#include "import/support.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

constexpr std::size_t strip_faces = 64, strip_vertices = 66;

GltfCopies row_of_strips(std::size_t places) {
  GltfCopies copies;
  for (std::size_t i = 0; i < places; ++i) copies.add(static_cast<float>(i), 0, 5);
  return copies;
}

MeshData read_copies(const std::string& bytes, const MeshReadSettings& settings = {}) {
  ReadResult read = read_bytes("a.gltf", bytes, settings);
  INFO(read.messages);
  CHECK(read.messages.empty());
  REQUIRE(read.mesh);
  return std::move(*read.mesh);
}

}  // namespace

TEST_CASE("a mesh at very many places of a glTF file is kept once") {
  const std::string other = R"(,{"name":"other","mesh":1})";
  const GltfCopies copies = row_of_strips(GltfCopies::enough);
  std::string bytes = copies.text(1, other, 1);
  bytes.insert(bytes.find(R"(],"materials")"),
               R"(,{"primitives":[{"mode":5,"material":0,"attributes":{"POSITION":0}}]})");
  const MeshData mesh = read_copies(bytes);
  CHECK(mesh.face_count() == strip_faces);
  CHECK(mesh.vertex_count() == strip_vertices);
  REQUIRE(mesh.copies.size() == 1);
  const MeshCopies& shared = mesh.copies.front();
  CHECK(shared.mesh->face_count() == strip_faces);
  CHECK(shared.mesh->positions[3] == 0);
  CHECK(shared.mesh->positions[6] == 1);
  CHECK(shared.mesh->normals.size() == 3 * strip_vertices);
  CHECK(shared.mesh->colors.size() == 3 * strip_vertices);
  REQUIRE(shared.places.size() == GltfCopies::enough);
  CHECK(shared.places[7].affine.origin.x == 7);
  CHECK(shared.places[7].affine.origin.z == 5);
  REQUIRE(mesh.parts.size() == 2);
  CHECK(mesh.parts[0].name == "strips");
  CHECK(mesh.parts[1].name == "other");
  CHECK(mesh.parts[1].first_face == 0);
  CHECK(shared.places[7].part == 0);
}

TEST_CASE("a glTF file of nothing but copies has the first as faces of its own") {
  const MeshData mesh = read_copies(row_of_strips(GltfCopies::enough).text());
  CHECK(mesh.face_count() == strip_faces);
  CHECK(mesh.positions[2] == 5);
  CHECK(mesh.parts.empty());
  REQUIRE(mesh.copies.size() == 1);
  CHECK(mesh.copies[0].places.size() == GltfCopies::enough - 1);
  CHECK(mesh.copies[0].places[0].affine.origin.x == 1);
}

TEST_CASE("few places, and small meshes, are joined") {
  const MeshData few = read_copies(row_of_strips(GltfCopies::enough - 1).text());
  CHECK(few.copies.empty());
  CHECK(few.face_count() == (GltfCopies::enough - 1) * strip_faces);
  const MeshData halves = read_copies(row_of_strips(GltfCopies::enough).text(2));
  CHECK(halves.copies.empty());
  CHECK(halves.face_count() == GltfCopies::enough * strip_faces);
}

TEST_CASE("no place is a copy where all faces are wanted in the file's space") {
  const MeshData mesh = read_copies(row_of_strips(GltfCopies::enough).text(), {.joined = true});
  CHECK(mesh.copies.empty());
  CHECK(mesh.face_count() == GltfCopies::enough * strip_faces);
}

TEST_CASE("places of a mesh that rays cannot be turned back from") {
  GltfCopies copies = row_of_strips(GltfCopies::enough);
  copies.add(1, 2, 3, 0, 0, 0);  // hidden
  copies.add(1, 2, 3, 1, 1, 0);  // flat, as the strip is anyway
  const MeshData mesh = read_copies(copies.text());
  CHECK(mesh.face_count() == strip_faces);
  CHECK(mesh.positions[2] == 3);
  REQUIRE(mesh.copies.size() == 1);
  CHECK(mesh.copies[0].places.size() == GltfCopies::enough);
}

TEST_CASE("faces that are left out of a mesh with copies are not counted for each") {
  std::string bytes = row_of_strips(GltfCopies::enough).text();
  // The strip's vertex 2 is beyond what there may be: three triangles have it.
  const std::string good = base64(bytes_of(std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0})),
                    bad = base64(
                        bytes_of(std::vector<float>{0, 0, 0, 0, 1, 0, std::numeric_limits<float>::infinity(), 0, 0}));
  const std::size_t at = bytes.find(good);
  REQUIRE(at != std::string::npos);
  bytes.replace(at, good.size(), bad);
  const ReadResult read = read_bytes("a.gltf", bytes);
  REQUIRE(read.mesh);
  // Those of the first place, which is joined, and those of the copies' mesh.
  CHECK(contains(read.messages, "2 vertices are not finite or beyond 1e18; 6 faces at them are left out"));
  CHECK(read.mesh->copies.at(0).mesh->face_count() == strip_faces - 3);
}

}  // namespace raytrace::test
