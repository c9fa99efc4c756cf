// What a glTF file says of its default scene, before a mesh is made of it. Inside of read_gltf().
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/import/gltf_primitive.h"
#include "raytrace/import/gltf_skin.h"
#include "raytrace/import/mesh_data.h"
#include "raytrace/import/read_mesh.h"
#include "raytrace/math/affine.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace::gltf {

struct Instance {
  const std::vector<Primitive>* mesh;
  Affine transform;                    ///< of what has no skin
  const std::vector<double>* weights;  ///< of the morph targets
  const Skin* skin = nullptr;          ///< null: none
  std::uint64_t node = 0;              ///< its number in Model::node_names
};

inline bool has_skin(const Primitive& primitive, const Instance& instance) {
  return instance.skin != nullptr && !primitive.joint_sets.empty();
}
inline bool is_deformed(const Primitive& primitive, const Instance& instance) {
  return has_skin(primitive, instance) || is_morphed(primitive, *instance.weights);
}

/// A skin mirrors as its first joint does.
inline bool is_mirrored(const Primitive& primitive, const Instance& instance) {
  const Affine& affine = has_skin(primitive, instance) ? instance.skin->joints.front() : instance.transform;
  return affine.determinant() < 0;
}

struct Model {
  std::unique_ptr<Document> document;               ///< what accessors point into
  std::vector<Instance> instances;                  ///< in the order of the nodes
  std::map<std::uint64_t, std::string> node_names;  ///< of those with a mesh
  std::map<std::uint64_t, std::vector<Primitive>> meshes;
  std::map<std::uint64_t, std::vector<double>> weights;  ///< of a node's mesh, if it has any
  std::map<std::uint64_t, Skin> skins;
  std::vector<MeshMaterial> materials;  ///< those that are used
  std::vector<FileCamera> cameras;
  std::vector<FileLight> lights;
  std::optional<double> animation_end{};  ///< as MeshData has it
  std::size_t other_primitives = 0;       ///< those of points and lines, which are left out
};

/// file: all of it. name: its file's, beside which others are. Warnings go to `diagnostics`. Throws Error.
Model read_model(std::string_view file, const std::string& name, const MeshReadSettings& settings,
                 Diagnostics& diagnostics);

}  // namespace raytrace::gltf
