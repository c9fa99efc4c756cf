// Which of a glTF file's nodes are copies of one mesh, which is then kept once. Inside of read_gltf().
#pragma once

#include <cstdint>
#include <vector>

#include "raytrace/import/gltf_model.h"

namespace raytrace::gltf {

/// What becomes of a model's instances.
struct CopyPlan {
  static constexpr std::uint32_t joined = 0xffffffff;  ///< with others, as faces of their own
  static constexpr std::uint32_t unseen = 0xfffffffe;  ///< nothing: its places leave no area of it

  /// Of each instance, joined or unseen, or the number of the mesh that it is a copy of.
  std::vector<std::uint32_t> of_instances;
  std::uint32_t meshes = 0;  ///< so many have copies
};

/// Copies are of meshes that are many and large enough for what it costs rays to follow them: they stand still in their
/// own space, without skins or morphs, and can be turned back into it.
/// all_joined: there are none (MeshReadSettings::joined).
CopyPlan plan_copies(const Model& model, bool all_joined);

}  // namespace raytrace::gltf
