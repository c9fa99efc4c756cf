// Subdivided meshes: their rules against closed forms, and that they have no cracks.
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "import/support.h"
#include "raytrace/import/subdivide_mesh.h"
#include "support/catch.h"
#include "support/mesh_edges.h"

namespace raytrace::test {
namespace {

/// The number of a point of a square grid of so many cells along each edge.
std::size_t at_point(int column, int row, int edge) {
  const int point = row * (edge + 1) + column;
  return static_cast<std::size_t>(point);
}

template <class T>
MeshBuffer<T> buffer_with(const std::vector<T>& values) {
  MeshBuffer<T> buffer(values.size());
  std::copy(values.begin(), values.end(), buffer.data());
  return buffer;
}

MeshData mesh_of(int corners, const std::vector<float>& positions, const std::vector<std::uint32_t>& indices) {
  MeshData mesh;
  mesh.corners = corners;
  mesh.positions = buffer_with(positions);
  mesh.indices = buffer_with(indices);
  return mesh;
}

MeshData cube() {
  return mesh_of(4, {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1},
                 {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7});
}

MeshData octahedron() {
  return mesh_of(3, {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
                 {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5});
}

/// An open one of quads with an edge of three faces, a triangle beside them, and a valence of five.
MeshData odd_mesh() {
  return mesh_of(4, {0, 0, 0, 1, 0,    0.2F, 2, 0, 0,    0, 1,    0.1F, 1, 1, 0.5F, 2, 1, 0,
                     0, 2, 0, 1, 2.2F, 0,    2, 2, 0.3F, 1, 0.5F, 2,    1, 2, 2,    3, 1, 0},
                 {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7, 4, 7, 10, 9, 5, 11, 8, 8});
}

/// A grid of squares in rows, with these heights; each square is two triangles or one quad.
MeshData grid(int edge, int corners, const std::vector<float>& heights) {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  for (int y = 0; y <= edge; ++y)
    for (int x = 0; x <= edge; ++x)
      positions.insert(positions.end(), {static_cast<float>(x), static_cast<float>(y), heights[at_point(x, y, edge)]});
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((y + j) * (edge + 1) + x + i); };
      if (corners == 4)
        indices.insert(indices.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
      else
        indices.insert(indices.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
    }
  return mesh_of(corners, positions, indices);
}

std::vector<float> random_heights(int edge) {
  std::mt19937 random(5);
  std::vector<float> heights;
  for (int i = 0; i < (edge + 1) * (edge + 1); ++i) heights.push_back(static_cast<float>(random()) * 0x1p-32F);
  return heights;
}

Vec3d position_of(const MeshData& mesh, std::size_t vertex) {
  return {mesh.positions[3 * vertex], mesh.positions[3 * vertex + 1], mesh.positions[3 * vertex + 2]};
}

/// Of a closed mesh whose faces are counter-clockwise from outside.
double volume_of(const MeshData& mesh) {
  double volume = 0;
  const auto corners = static_cast<std::size_t>(mesh.corners);
  for (std::size_t face = 0; face < mesh.face_count(); ++face)
    for (std::size_t i = 1; i + 1 < corners; ++i) {
      const auto at = [&](std::size_t k) { return position_of(mesh, mesh.indices[corners * face + k]); };
      volume += dot(at(0), cross(at(i), at(i + 1))) / 6;
    }
  return volume;
}

/// The same mesh with vertices of their own for each face.
MeshData unwelded(const MeshData& mesh) {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  for (const std::uint32_t vertex : mesh.indices) {
    for (std::size_t k = 0; k < 3; ++k) positions.push_back(mesh.positions[3 * std::size_t{vertex} + k]);
    indices.push_back(static_cast<std::uint32_t>(indices.size()));
  }
  return mesh_of(mesh.corners, positions, indices);
}

/// Texture coordinates that follow from the positions: u = x, v = y.
MeshBuffer<float> uvs_by_place(const MeshData& mesh) {
  MeshBuffer<float> uvs(2 * mesh.vertex_count());
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
    for (std::size_t k = 0; k < 2; ++k) uvs[2 * i + k] = mesh.positions[3 * i + k];
  return uvs;
}

}  // namespace

TEST_CASE("a subdivided cube has its known limit points, whatever the level") {
  for (const int levels : {1, 2, 5}) {
    const MeshData fine = subdivided(cube(), {.levels = levels});
    INFO(levels);
    CHECK(fine.face_count() == 6U << (2 * (static_cast<unsigned>(levels) - 1)) << 2U);
    // The masks of a corner: (n - 1) / (n + 5) of itself, 2 and 4 / (n (n + 5)) of the sums of neighbours and faces.
    for (int axis = 0; axis < 3; ++axis) CHECK(component(position_of(fine, 6), axis) == Approx(0.5));
    if (levels > 1) continue;
    // In the middle of the face y = 1, of which four corners, four edges' points and itself count.
    double highest = 0, on_edge = 0;
    for (std::size_t i = 0; i < fine.vertex_count(); ++i) {
      const Vec3d p = position_of(fine, i);
      if (std::abs(p.x) < 1e-6 && std::abs(p.z) < 1e-6) highest = std::max(highest, p.y);
      if (std::abs(p.x) < 1e-6 && p.y > 0 && p.z > 0) on_edge = p.y;
    }
    CHECK(highest == Approx((16 + 4 * 4 * 0.75 + 4 * 5.0 / 9) / 36));
    // On an edge: 16 of its point, 4 of two corners and two faces (1 and 0), 1 of four edges' points, two with 0.75.
    CHECK(on_edge == Approx((16 * 0.75 + 4 * (2 * 5.0 / 9 + 1) + 4 * 0.375) / 36));
  }
}

TEST_CASE("levels of subdivision have their vertices on one surface") {
  MeshData with_uvs = odd_mesh();
  with_uvs.uvs = uvs_by_place(with_uvs);
  MeshData seam = unwelded(grid(3, 4, random_heights(3)));
  seam.uvs = uvs_by_place(seam);
  for (std::size_t i = 0; i < seam.uvs.size() / 2; ++i) seam.uvs[i] += 5;  // some of the faces: others are not beside
  const MeshData* const meshes[] = {&with_uvs, &seam};
  std::vector<MeshData> others;
  others.push_back(cube());
  others.push_back(octahedron());
  others.push_back(grid(3, 3, random_heights(3)));
  others.push_back(mesh_of(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
  std::vector<const MeshData*> all(std::begin(meshes), std::end(meshes));
  for (const MeshData& mesh : others) all.push_back(&mesh);
  for (const MeshData* mesh : all) {
    MeshData coarse = subdivided(*mesh, {.levels = 1});
    for (int levels = 2; levels <= 4; ++levels) {
      MeshData fine = subdivided(*mesh, {.levels = levels});
      double worst = 0;
      for (std::size_t i = 0; i < coarse.positions.size(); ++i)
        worst = std::max(worst, double{std::abs(coarse.positions[i] - fine.positions[i])});
      for (std::size_t i = 0; i < coarse.uvs.size(); ++i)
        worst = std::max(worst, double{std::abs(coarse.uvs[i] - fine.uvs[i])});
      CHECK(worst < 1e-6);
      CHECK(fine.uvs.empty() == mesh->uvs.empty());
      coarse = std::move(fine);
    }
  }
}

TEST_CASE("a regular grid of quads becomes the bicubic B-spline of its vertices") {
  constexpr int edge = 6;
  const std::vector<float> heights = random_heights(edge);
  const MeshData fine = subdivided(grid(edge, 4, heights), {.levels = 1});
  // Of the cubic B-spline, at a knot and between two.
  const auto weights = [](double t, int i) {
    const double knots[] = {1.0 / 6, 4.0 / 6, 1.0 / 6, 0}, halves[] = {1.0 / 48, 23.0 / 48, 23.0 / 48, 1.0 / 48};
    return t == 0 ? knots[i] : halves[i];
  };
  int compared = 0;
  for (std::size_t i = 0; i < fine.vertex_count(); ++i) {
    const Vec3d p = position_of(fine, i);
    if (p.x < 2 - 1e-6 || p.x > edge - 2 + 1e-6 || p.y < 2 - 1e-6 || p.y > edge - 2 + 1e-6) continue;
    const double x = std::round(2 * p.x) / 2, y = std::round(2 * p.y) / 2;
    CHECK(std::abs(p.x - x) + std::abs(p.y - y) < 1e-6);
    double height = 0;
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 4; ++j) {
        const int column = static_cast<int>(x) - 1 + j, row = static_cast<int>(y) - 1 + k;
        height += weights(x - std::floor(x), j) * weights(y - std::floor(y), k) *
                  double{heights[at_point(column, row, edge)]};
      }
    CHECK(p.z == Approx(height).margin(1e-6));
    ++compared;
  }
  CHECK(compared == 25);
}

TEST_CASE("a regular grid of triangles becomes the quartic box spline of its vertices") {
  constexpr int edge = 4;
  const std::vector<float> heights = random_heights(edge);
  const MeshData fine = subdivided(grid(edge, 3, heights), {.levels = 3});
  const auto at = [&](int x, int y) { return double{heights[at_point(x, y, edge)]}; };
  for (int y = 2; y <= edge - 2; ++y)
    for (int x = 2; x <= edge - 2; ++x) {
      const double ring =
          at(x + 1, y) + at(x - 1, y) + at(x, y + 1) + at(x, y - 1) + at(x + 1, y + 1) + at(x - 1, y - 1);
      const Vec3d p = position_of(fine, at_point(x, y, edge));
      CHECK(p.z == Approx(at(x, y) / 2 + ring / 12).margin(1e-6));
    }
}

TEST_CASE("a flat grid stays flat, its corners and its rim stay, and texture coordinates stay with it") {
  for (const bool flat : {false, true}) {
    MeshData mesh = grid(4, 4, std::vector<float>(25, 0.0F));
    mesh.uvs = uvs_by_place(mesh);
    const MeshData fine = subdivided(mesh, {.levels = 3, .flat = flat});
    CHECK(fine.face_count() == 16 * 64);
    CHECK(fine.vertex_count() == 33 * 33);
    std::size_t corners = 0, on_rim = 0;
    for (std::size_t i = 0; i < fine.vertex_count(); ++i) {
      const Vec3d p = position_of(fine, i);
      CHECK(p.z == 0);
      // Spline points run closer together at the rim, and texture coordinates are straight there.
      const double off = std::max(std::abs(p.x - double{fine.uvs[2 * i]}), std::abs(p.y - double{fine.uvs[2 * i + 1]}));
      CHECK(off < (flat ? 1e-6 : 0.2));
      const bool x_rim = p.x == 0 || p.x == 4, y_rim = p.y == 0 || p.y == 4;
      corners += x_rim && y_rim ? 1U : 0U;
      on_rim += x_rim || y_rim ? 1U : 0U;
    }
    CHECK(corners == 4);
    CHECK(on_rim == 4 * 32);
  }
}

TEST_CASE("flat subdivision keeps the form of a cube, and smooth one has its limit's volume") {
  CHECK(volume_of(subdivided(cube(), {.levels = 4, .flat = true})) == Approx(8).epsilon(1e-6));
  CHECK(volume_of(subdivided(octahedron(), {.levels = 4, .flat = true})) == Approx(4.0 / 3).epsilon(1e-6));
  // A form inside of a convex one nears it by a quarter of the difference from level to level.
  for (const MeshData& mesh : {cube(), octahedron()}) {
    const double v3 = volume_of(subdivided(mesh, {.levels = 3})), v4 = volume_of(subdivided(mesh, {.levels = 4})),
                 v5 = volume_of(subdivided(mesh, {.levels = 5}));
    CHECK(v3 < v4);
    CHECK((v5 - v4) / (v4 - v3) == Approx(0.25).epsilon(0.05));
  }
}

TEST_CASE("corners in one place are of one vertex, whatever their texture coordinates, and no crack opens") {
  for (const bool flat : {false, true}) {
    for (const MeshData& whole : {cube(), octahedron()}) {
      MeshData mesh = unwelded(whole);
      mesh.uvs = MeshBuffer<float>(2 * mesh.vertex_count());
      for (std::size_t i = 0; i < mesh.uvs.size(); ++i)
        mesh.uvs[i] = static_cast<float>(i * 37 % 11);  // seams everywhere
      const MeshData fine = subdivided(mesh, {.levels = 3, .flat = flat}),
                     of_whole = subdivided(whole, {.levels = 3, .flat = flat});
      CHECK(fine.vertex_count() > of_whole.vertex_count());
      const auto edges = edges_by_faces(fine);
      CHECK(edges.size() == 1);
      CHECK(edges.contains(2));
      CHECK(volume_of(fine) == volume_of(of_whole));
    }
  }
}

TEST_CASE("what vertices have is linear along seams, smooth elsewhere, and stays between its ends") {
  // Two squares beside each other whose coordinates jump at the edge between them.
  MeshData mesh =
      mesh_of(4, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0}, {0, 1, 2, 3, 4, 5, 6, 7});
  mesh.uvs = buffer_with<float>({0, 0, 1, 0, 1, 1, 0, 1, 5, 0, 6, 0, 6, 1, 5, 1});
  mesh.alphas = buffer_with<float>({0, 1, 1, 0, 1, 0, 0, 1});
  const MeshData fine = subdivided(mesh, {.levels = 2});
  REQUIRE(fine.face_count() == 32);
  std::size_t on_seam = 0;
  for (std::size_t i = 0; i < fine.vertex_count(); ++i) {
    const double u = fine.uvs[2 * i], v = fine.uvs[2 * i + 1];
    CHECK(((u >= 0 && u <= 1) || (u >= 5 && u <= 6)));
    CHECK((fine.alphas[i] >= 0 && fine.alphas[i] <= 1));
    if (u == 1 || u == 5) {
      ++on_seam;
      CHECK(fine.positions[3 * i] == 1.0F);
      CHECK(fine.alphas[i] == 1.0F);
      CHECK(std::abs(v * 4 - std::round(v * 4)) < 1e-6);
    }
  }
  CHECK(on_seam == 2 * 5);
}

TEST_CASE("texture coordinates that are far out do not make colours coarse") {
  const auto fine = [](float farthest) {
    MeshData mesh = mesh_of(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 9, 9, 9, 9, 8, 9, 8, 9, 9},
                            {0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3, 4, 5, 6});
    mesh.uvs = buffer_with<float>({0, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0, farthest, 1});
    mesh.colors = MeshBuffer<float>(21);
    for (std::size_t i = 0; i < 21; ++i) mesh.colors[i] = static_cast<float>(i * 7 % 5) / 5;
    return subdivided(mesh, {.levels = 2});
  };
  CHECK(values(fine(1e30F).colors) == values(fine(0).colors));
}

TEST_CASE("finer faces have the materials and the parts of those that they are of") {
  MeshData mesh = cube();
  mesh.face_materials = buffer_with<std::uint32_t>({0, 1, 2, 3, 4, MeshData::no_material});
  mesh.parts = {{"lower", 0}, {"upper", 4}};
  const MeshData fine = subdivided(mesh, {.levels = 2, .flat = true});
  REQUIRE(fine.face_count() == 96);
  for (std::size_t i = 0; i < 96; ++i) CHECK(fine.face_materials[i] == mesh.face_materials[i / 16]);
  REQUIRE(fine.parts.size() == 2);
  CHECK(fine.parts[1].first_face == 64);
  // Parts are surfaces of their own, with rims where they touch.
  const MeshData smooth = subdivided(mesh, {.levels = 1});
  CHECK(smooth.vertex_count() > subdivided(cube(), {.levels = 1}).vertex_count());
}

TEST_CASE("a vertex where two fans of faces touch stays, as one of an edge of three faces does that ends there") {
  // Two tetrahedra with one vertex in common.
  const MeshData mesh = mesh_of(3, {0, 0, 0, 1, 0, 1, 0, 1, 1, -1, -1, 1, 2, 0, -1, 0, 3, -2, -1, -1, -1},
                                {0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3, 0, 4, 5, 0, 5, 6, 0, 6, 4, 4, 6, 5});
  const MeshData fine = subdivided(mesh, {.levels = 2});
  CHECK(length(position_of(fine, 0)) == 0);
  CHECK(length(position_of(fine, 1) - position_of(mesh, 1)) > 0.1);
}

TEST_CASE("polygons of files are subdivided as a whole, and quads among more triangles stay quads") {
  // A prism of five sides: two pentagons, which are six triangles, and five quads.
  std::string obj;
  for (const int z : {0, 1})
    for (int i = 0; i < 5; ++i)
      obj += "v " + std::to_string(std::cos(i * 1.2566370614)) + " " + std::to_string(std::sin(i * 1.2566370614)) +
             " " + std::to_string(z) + "\n";
  obj += "f 5 4 3 2 1\nf 6 7 8 9 10\n";
  for (int i = 0; i < 5; ++i) {
    const int next = (i + 1) % 5;
    obj += "f " + std::to_string(i + 1) + " " + std::to_string(next + 1) + " " + std::to_string(next + 6) + " " +
           std::to_string(i + 6) + "\n";
  }
  CHECK(read_bytes("prism.obj", obj).mesh.value().corners == 3);
  const MeshData mesh = read_bytes("prism.obj", obj, {.polygons = true}).mesh.value();
  CHECK(mesh.corners == 4);
  CHECK(values(mesh.continued) == std::vector<std::uint8_t>{0, 1, 1, 0, 1, 1, 0, 0, 0, 0, 0});
  CHECK(subdivided_faces(mesh, {.levels = 1}) == 30);
  const MeshData fine = subdivided(mesh, {.levels = 1});
  CHECK(fine.face_count() == 30);
  CHECK(fine.vertex_count() == 10 + 7 + 15);
  CHECK(edges_by_faces(fine) == std::map<int, int>{{2, 60}});
  // The middle of a pentagon stays on the axis.
  double off_axis = 9;
  for (std::size_t i = 10; i < 17; ++i)
    off_axis = std::min(off_axis, std::hypot(position_of(fine, i).x, position_of(fine, i).y));
  CHECK(off_axis < 1e-6);

  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n2 0 0\n2 1 0\n1 2 0\n0 1 0\n3 3 0\n";
  CHECK(subdivided(read_bytes("p.ply", ply + "5 0 1 2 3 4\n3 2 5 3\n", {.polygons = true}).mesh.value(), {.levels = 1})
            .face_count() == 8);
  // A triangle that is left out takes no other polygon's place.
  const MeshData pinched = read_bytes("p.ply", ply + "3 2 5 3\n5 0 0 1 2 3\n", {.polygons = true}).mesh.value();
  CHECK(pinched.continued[1] == 0);
  CHECK(subdivided(pinched, {.levels = 1}).face_count() >= 3 + 4);
}

TEST_CASE("subdivision has the same bits with any number of threads") {
  MeshData mesh = unwelded(grid(8, 4, random_heights(8)));
  mesh.uvs = uvs_by_place(mesh);
  const MeshData one = subdivided(mesh, {.levels = 5, .threads = 1}),
                 many = subdivided(mesh, {.levels = 5, .threads = 7});
  CHECK(one.face_count() == 65536);
  CHECK(same_mesh(one, many));
}

TEST_CASE("meshes that would become too large are refused before anything is made") {
  MeshData mesh = grid(30, 4, std::vector<float>(31 * 31, 0.0F));
  CHECK_FALSE(too_many_subdivisions(mesh, {.levels = 3}));
  CHECK(too_many_subdivisions(mesh, {.levels = 12}).value() ==
        "would have 15099494400 faces after 12 subdivisions; at most 268435456 are possible");
}

}  // namespace raytrace::test
