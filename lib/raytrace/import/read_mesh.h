// Meshes and point clouds from files.
//
//   PLY  .ply: ASCII and both binary orders; any types; elements and properties that have no meaning here are skipped.
//        `vertex`: x y z; nx ny nz; u v, s t, texture_u texture_v or texture_s texture_t; red green blue.
//        `face`: a list vertex_indices or vertex_index; a list texcoord of u v for each corner, in place of the
//        vertices' texture coordinates; texnumber. `comment TextureFile NAME`: the colour of a material, white but for
//        it, where there are texture coordinates; that of the faces with its texnumber, counted from 0, or of all.
//   OBJ  .obj: polygons (v, vt, vn, f; negative indices; colours after a position); materials from MTL files; objects
//        are parts. Groups and smoothing groups are not kept; lines, points, curves and free-form surfaces are skipped.
//   STL  .stl: ASCII and binary.
//   glTF .gltf, .glb: 2.0, the meshes of the default scene's nodes, in world space, morphed and skinned, as an
//        animation has them at a time; materials, of one variant; cameras and lights. Buffers and images may be files,
//        URIs "data:" or parts of a GLB file. docs/models.md lists the extensions; points and lines are skipped.
//
// Each may be compressed by gzip, with .gz behind the name.
//
// Faces. Where at least half of the faces are quads, they stay quads, and all others become triangles in a mesh of
// quads; else quads become triangles. A quad is two triangles that meet at the diagonal between its second and fourth
// corner, as in Embree; a quad with a dent starts with another corner, so that this diagonal is inside. A polygon
// of more corners is a fan of triangles around its first corner if it is convex or has more than 128 corners, else its
// ears are cut off one by one. Faces whose corners repeat, so that they have no area, are left out with one warning
// that counts them, and so are those at a vertex that is not finite or beyond 1e18.
//
// Colours of integer type are sRGB, from 0 to 255 (of 16 bits: to 65535), and become linear; those of type float, and
// all of glTF, are linear already.
//
// Memory. No array is allocated before it is known that the file has the values for it. A compressed file may become as
// large as a quarter of the memory that is available, and so may a glTF mesh that many nodes have; more is an error.
//
// The result does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "raytrace/import/mesh_data.h"
#include "raytrace/math/vec3.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

struct MeshReadSettings {
  /// Subtracted from the positions in double precision, before they are rounded to float: what is far from the origin
  /// of its file keeps its detail.
  Vec3d origin{0, 0, 0};
  /// Corners of an STL file at the same position are one vertex, which smooth normals need. Each facet has its
  /// own three otherwise.
  bool weld = true;
  // Of a glTF file; for others they must be empty, but that the first animation may be asked for as "0".
  std::string animation{};  ///< its name, or its number from 0, or all; empty: the model is at rest
  double time = 0;          ///< of it, in seconds; beyond its ends it stands still
  std::string variant{};  ///< of the materials, by its name or number; empty: those that primitives have by themselves
  /// Keep the alphas of vertices whatever the file's materials are, since one of the scene's wants them. Otherwise only
  /// those are kept that a glTF material shows.
  bool vertex_alphas = false;
  /// Keep quads where most faces are triangles, and which triangles are of one polygon (MeshData::continued), as
  /// subdivided() wants it.
  bool polygons = false;
  /// Leave no copies in spaces of their own (MeshData::copies): all faces are in the file's space, in which heights and
  /// textures in space then have one measure.
  bool joined = false;
  int threads = 0;  ///< at most; 0: all that the machine has
  /// Whether faces have another material in place of the file's of that name, which nothing need be said of then.
  /// Null: none have.
  std::function<bool(std::string_view material)> is_overridden{};

  bool overrides(std::string_view material) const { return is_overridden && is_overridden(material); }
};

/// No value, and errors, if the file cannot be read or is not what it should be. Errors have the line, or name the byte
/// where the file is binary, or the value of glTF's JSON, such as accessors[3]. diagnostics: of that file. Throws
/// std::bad_alloc.
std::optional<MeshData> read_mesh(const std::string& file, const MeshReadSettings& settings, Diagnostics& diagnostics);

/// For MeshReadSettings, of a mesh or cloud that was read without: the origin of the world if the first position is
/// near it, and not much farther away than the positions from each other; else this position, rounded.
Vec3d near_origin(std::span<const float> positions);

/// A mesh of values that are at hand. corners: of the faces, which end there, each of at least three; they are vertices
/// that exist. normals, uvs, uvs2: of each vertex; empty: none. polygons: as MeshReadSettings has it.
std::optional<MeshData> make_mesh(std::span<const double> positions, std::span<const double> corners,
                                  std::span<const std::uint32_t> face_ends, std::span<const double> normals,
                                  std::span<const double> uvs, std::span<const double> uvs2, bool polygons,
                                  Diagnostics& diagnostics);

/// The elements `vertex` of a PLY file, with x, y, z, radius and red, green, blue.
std::optional<PointCloud> read_point_cloud(const std::string& file, const MeshReadSettings& settings,
                                           Diagnostics& diagnostics);

/// Whether read_mesh() knows files of that name, by its ending.
bool is_mesh_file(const std::string& file);

}  // namespace raytrace
