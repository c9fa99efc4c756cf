// The faces, edges and vertices of a mesh that is subdivided, and how each step numbers those of the next. Inside of
// subdivided().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raytrace/import/mesh_data.h"
#include "raytrace/memory/large_array.h"

namespace raytrace {

/// The polygons of a mesh, each of three corners or more in as many places.
struct MeshPolygons {
  std::vector<std::uint32_t> begins;    ///< of each polygon, its first corner; and the number of corners
  std::vector<std::uint32_t> vertices;  ///< of each corner, that of the mesh
  std::vector<std::uint32_t> faces;     ///< of each polygon, the face of the mesh that it begins with
  std::vector<std::uint32_t> parts;     ///< of each polygon; empty: all are one

  std::size_t count() const { return faces.size(); }
  bool are_triangles() const { return vertices.size() == 3 * count(); }
};

MeshPolygons polygons_of(const MeshData& mesh);

/// What becomes of a vertex where its neighbours are smoothed.
enum class VertexKind : std::uint8_t {
  smooth,
  crease,  ///< it moves with its two sharp edges
  fixed,
};

/// Corners are numbered face by face. Each stands for the edge to the next corner of its face, too.
struct SubdivisionTopology {
  static constexpr std::uint32_t none = 0xffffffff;

  struct Edge {
    std::array<std::uint32_t, 2> vertices;
    std::array<std::uint32_t, 2> corners;  ///< in two faces; of a sharp edge, the second is none

    bool is_sharp() const { return corners[1] == none; }
    /// Which of its halves is that at a vertex of its.
    std::uint32_t half_at(std::uint32_t vertex) const { return vertices[0] == vertex ? 0 : 1; }
  };

  std::size_t vertex_count = 0, face_count = 0, corner_count = 0, edge_count = 0;
  std::uint32_t face_corners = 0;        ///< of each face; 0: they differ
  LargeArray<std::uint32_t> begins{};    ///< where they differ: of each face, its first corner; and corner_count
  LargeArray<std::uint32_t> vertices{};  ///< of each corner
  LargeArray<std::uint32_t> corner_edges{};
  LargeArray<Edge> edges{};
  LargeArray<VertexKind> kinds{};  ///< of each vertex

  std::uint32_t first_corner(std::size_t face) const {
    return face_corners != 0 ? static_cast<std::uint32_t>(face * face_corners) : begins[face];
  }
  std::uint32_t corners_of(std::size_t face) const {
    return face_corners != 0 ? face_corners : begins[face + 1] - begins[face];
  }
  std::uint32_t face_of(std::uint32_t corner) const;
  std::uint32_t next(std::uint32_t corner) const;
  std::uint32_t previous(std::uint32_t corner) const;
};

/// Of polygons whose corners have these numbers of vertices, from 0 to vertex_count - 1.
SubdivisionTopology topology_of(const MeshPolygons& polygons, const std::uint32_t* numbers, std::size_t vertex_count,
                                int threads);

/// For what is linear at sharp edges: vertices there are fixed, and so are those whose positions are, which have the
/// numbers and the kinds of another topology of the same corners.
void fix_sharp_vertices(SubdivisionTopology& topology, const SubdivisionTopology& positions, int threads);

/// How many faces, vertices and corners there are after a step. triangles: each is cut into four; else each polygon
/// into quads.
struct SubdivisionCounts {
  std::size_t faces, vertices, corners;
};
SubdivisionCounts counts_after_step(const SubdivisionTopology& topology, bool triangles);

/// Vertices after a step: first those that were there, then those within faces, unless these are triangles, then those
/// on edges.
inline std::uint32_t vertex_on_edge(const SubdivisionTopology& topology, bool triangles, std::uint32_t edge) {
  return static_cast<std::uint32_t>(topology.vertex_count + (triangles ? 0 : topology.face_count)) + edge;
}

/// Writes the vertices of the corners after a step.
void write_next_faces(const SubdivisionTopology& topology, bool triangles, std::uint32_t* out, int threads);

/// All of it after a step. linear_edges: new vertices on sharp edges are fixed.
SubdivisionTopology next_topology(const SubdivisionTopology& topology, bool triangles, bool linear_edges, int threads);

}  // namespace raytrace
