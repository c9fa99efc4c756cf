// What a node's mesh is before it is placed: morphed and skinned. Inside of read_gltf().
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/import/gltf_document.h"
#include "raytrace/import/gltf_primitive.h"
#include "raytrace/math/affine.h"
#include "raytrace/math/vec3.h"

namespace raytrace::gltf {

/// What each joint does to the mesh's vertices, into the scene. transform: of the node of that number into the scene;
/// none: it is not there.
struct Skin {
  std::string place;
  std::vector<Affine> joints;
};
Skin read_skin(Document& document, const Item& skin,
               const std::function<std::optional<Affine>(const Item& node)>& transform);

/// A primitive's vertices.
struct Vertices {
  std::vector<Vec3d> positions, normals;  ///< no normals: it has none
};
constexpr std::size_t bytes_of_deformed_vertex = 240;  ///< at most, while they are made

/// weights: of the morph targets; beyond them, 0. skin: null, none. Throws Error where a joint is none of the skin's.
Vertices deformed(const Primitive& primitive, const std::vector<double>& weights, const Skin* skin, int threads);

/// Whether they change the primitive.
inline bool is_morphed(const Primitive& primitive, const std::vector<double>& weights) {
  for (std::size_t i = 0; i < weights.size() && i < primitive.targets.size(); ++i)
    if (weights[i] != 0) return true;
  return false;
}

}  // namespace raytrace::gltf
