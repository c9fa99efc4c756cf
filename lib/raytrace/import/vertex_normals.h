// Normals of a mesh's vertices for smooth shading.
#pragma once

#include "raytrace/import/mesh_data.h"
#include "raytrace/import/unique_items.h"

namespace raytrace {

/// For each vertex the mean of the normals of the faces at its position, by the angles that they have there (Thürmer
/// and Wüthrich, "Computing Vertex Normals from Polygonal Facets", JGT 1998): unit vectors, or 0 0 0 where the faces
/// have no area or cancel each other. Vertices at one position have the same, whatever their uvs. positions: the
/// mesh's, or others in place of them. The result does not depend on the number of threads.
MeshBuffer<float> vertex_normals(const MeshData& mesh, const float* positions, int threads);

/// Which of so many positions are the same.
UniqueItems unique_positions(const float* positions, std::size_t count, int threads);

}  // namespace raytrace
