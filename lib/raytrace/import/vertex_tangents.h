// Tangents of a mesh's vertices, for normal maps and brushed metals on smooth meshes.
#pragma once

#include <array>
#include <cstdint>

#include "raytrace/import/mesh_data.h"

namespace raytrace {

/// What tangents follow from: a mesh as it stands in the scene.
struct TangentSource {
  const MeshData& mesh;          ///< its corners and counts, not its buffers
  const float* positions;        ///< x y z of each vertex
  const std::uint32_t* indices;  ///< of each corner of each face
  const float* normals;          ///< x y z of each vertex, of any length; 0 0 0: it has none
  const float* uvs;              ///< u v of each vertex
};

/// Of each vertex four numbers: the direction in which u grows, across its normal, of unit length, and 1, or -1 where v
/// grows against normal x tangent. 0 0 0 0: it has none. First those of faces that their texture does not mirror, then
/// of those that it does, since both may share vertices; empty where there are no such faces.
using VertexTangents = std::array<MeshBuffer<float>, 2>;

/// Those that normal maps are made for (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008; glTF 2.0, section
/// 3.7.2.1): for each vertex the mean of the tangents of the faces at it, each across the vertex's normal, by the
/// angles that they have there. Vertices of the same position, normal and coordinates are one. The result does not
/// depend on the number of threads.
VertexTangents vertex_tangents(const TangentSource& source, int threads);

}  // namespace raytrace
