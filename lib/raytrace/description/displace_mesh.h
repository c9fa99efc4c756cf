// Meshes whose vertices a texture moves.
#pragma once

#include <optional>
#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace {

struct Displacement {
  TextureUse texture;
  double height = 1;    ///< in the mesh's units, of a 1 of the texture
  double midlevel = 0;  ///< where the texture has this value vertices stay
};

/// Moves each vertex along the mean of the normals around it (import/vertex_normals.h). The texture is looked up as
/// wide as the vertex's longest edge is, along u and v each, so that it has no more detail than the vertices can show.
/// Vertices in one place move by the mean of their displacements, and so stay in one place. What the texture has no
/// value for stays: it could not be read, or has no tile there. A texture in space is in the mesh's own. Normals and
/// tangents of before are left out; copies stay. Why it cannot be done, worded to follow "the mesh "; the mesh is then
/// of no use. The result does not depend on the number of threads.
std::optional<std::string> displace(MeshData& mesh, const SceneDescription& scene, const Displacement& displacement,
                                    int threads);

}  // namespace raytrace
