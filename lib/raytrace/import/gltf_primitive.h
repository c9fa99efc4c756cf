// Primitives of a glTF file's meshes. Inside of read_gltf().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "raytrace/import/gltf_document.h"
#include "raytrace/import/gltf_draco.h"
#include "raytrace/import/mesh_data.h"

namespace raytrace::gltf {

/// How corners make triangles, as the format numbers it.
enum class Mode { triangles = 4, strip, fan };

/// What a morph target adds to each vertex, times its weight.
struct MorphTarget {
  std::optional<Accessor> positions, normals;
};

/// Four joints of a skin for each vertex, and how much each counts.
struct JointSet {
  Accessor joints, weights;
};

struct Primitive {
  Accessor positions;
  std::optional<Accessor> normals, tangents, uvs, uvs2, colors, indices;
  std::vector<MorphTarget> targets;
  std::vector<JointSet> joint_sets;
  Mode mode = Mode::triangles;
  std::uint32_t material = MeshData::no_material;  ///< its number in the model
  std::size_t vertices_of = 0;                     ///< the first primitive of the mesh that has the same vertices
  bool shows_alpha = false;                        ///< its material shows that of its vertices' colours

  bool has_alpha() const { return colors && colors->elements.components == 4; }

  std::size_t corners() const { return indices ? indices->elements.count : positions.elements.count; }
  std::size_t faces() const {
    if (mode == Mode::triangles) return corners() / 3;
    return corners() < 3 ? 0 : corners() - 2;
  }
  /// The three corners of face i.
  std::array<std::size_t, 3> face(std::size_t i) const {
    if (mode == Mode::strip) return {i, i + 1 + i % 2, i + 2 - i % 2};
    if (mode == Mode::fan) return {i + 1, i + 2, 0};
    return {3 * i, 3 * i + 1, 3 * i + 2};
  }
};

struct PrimitiveMaterial {
  std::uint32_t number = MeshData::no_material;  ///< in the model
  /// Its textures are placed by TEXCOORD_n of these numbers, of which there are at most two.
  std::vector<std::uint64_t> coordinates{};
  bool is_overridden = false;  ///< nothing is said of it
  bool is_thin_glass = false;  ///< clear, and a thin wall
  bool shows_alpha = false;    ///< by its alphaMode
};

/// Those of a mesh that have faces. material: what the model has for that of the file. other_primitives
/// counts those of points and lines, or without positions.
std::vector<Primitive> read_primitives(Document& document, DracoReader& draco, const Item& mesh,
                                       std::optional<std::uint64_t> variant,
                                       const std::function<PrimitiveMaterial(const Item&)>& material,
                                       std::size_t& other_primitives);

}  // namespace raytrace::gltf
