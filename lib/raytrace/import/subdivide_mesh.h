// Meshes with finer faces in place of their own.
//
// Faces are subdivided by Catmull and Clark's rules ("Recursively generated B-spline surfaces on arbitrary topological
// meshes", 1978): a polygon of n corners becomes n quads, and a quad four. A mesh of triangles alone is subdivided by
// Loop's ("Smooth Subdivision Surfaces Based on Triangles", 1987), a triangle into four, since Catmull and
// Clark's make waves of triangles. After the last step the vertices move to where infinitely many steps would bring
// them (Halstead, Kass and DeRose, "Efficient, fair interpolation using Catmull-Clark surfaces", SIGGRAPH 1993), so
// that a coarse form lies on the same surface as a fine one.
//
// Vertices of a part at one position are one, whatever else they have: there are no cracks. An edge with another number
// of faces than two is sharp: it becomes a cubic B-spline of its own, whatever is beside it. A vertex with two such
// edges but only one face, with another number of such edges, or where faces meet in this point alone, stays in place.
// That is OpenSubdiv's "edge and corner".
//
// Texture coordinates, colours and alphas are smoothed by the same rules, but linear along edges where one of them
// jumps, and at boundaries: OpenSubdiv's "boundaries", Blender's "keep boundaries". Flat faces are linear in all.
//
// Precision. What is around a vertex is added up in whole numbers of a unit that is the same in all of a mesh, some
// 2^-57 of the largest value of that kind (positions, each set of texture coordinates, colours, alphas). With one point
// 1e12 times as far out as the mesh is large, the others are about 1e-7 of its size off, as floats are anyway; at 1e17
// times it is a hundredth.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "raytrace/import/mesh_data.h"

namespace raytrace {

struct SubdivisionSettings {
  int levels = 1;        ///< how often, from 1 to 12
  bool flat = false;     ///< faces are cut and stay where they are
  bool normals = false;  ///< of flat faces: keep the mesh's, if it has any, else leave them out
  int threads = 0;
};

/// How many faces that makes, copies included, as far as they are counted: at most 2^62.
std::size_t subdivided_faces(const MeshData& mesh, const SubdivisionSettings& settings);

/// Why such a mesh would be too large, worded to follow "the mesh "; none if it is not. As far as memory is concerned,
/// that depends on what the machine has left.
std::optional<std::string> too_many_subdivisions(const MeshData& mesh, const SubdivisionSettings& settings);

/// The mesh with finer faces, in the order of those that they are of. It has no normals but those that the settings
/// say, no tangents and no copies; of materials, parts and the rest it has those of the mesh. Faces whose corners are
/// in less than three places are left out. Where the mesh says which triangles are of one polygon
/// (MeshData::continued), that is one face. The result does not depend on the number of threads. Throws std::bad_alloc.
MeshData subdivided(const MeshData& mesh, const SubdivisionSettings& settings);

}  // namespace raytrace
