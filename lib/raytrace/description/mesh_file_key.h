// What meshes and models read of their files.
#pragma once

#include <set>
#include <string>
#include <tuple>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// The file, its animation, the time, the variant, whether materials are overridden and whether polygons are kept: what
/// is the same for several meshes is read once.
using MeshFileKey = std::tuple<std::string, std::string, double, std::string, bool, bool>;

/// Of a mesh or a model.
template <class Parameters>
MeshFileKey key_of(const Parameters& parameters) {
  const std::string& animation = parameters.animation.name;
  // The time is of an animation alone.
  return {parameters.file.path,
          animation,
          animation.empty() ? 0 : parameters.time,
          parameters.variant.name,
          parameters.overridematerials,
          parameters.subdivision > 0};
}

/// Those of which something in the scene has the materials of the file.
inline std::set<MeshFileKey> files_with_shown_materials(const SceneDescription& scene) {
  std::set<MeshFileKey> keys;
  const auto add = [&](const auto& items) {
    for (const auto& item : items)
      if (item.material == no_material) keys.insert(key_of(item.parameters));
  };
  const auto add_all = [&](const ObjectLists& objects) {
    add(std::get<ObjectItems<Mesh>>(objects));
    add(std::get<ObjectItems<Model>>(objects));
  };
  add_all(scene.objects);
  for (const Group& group : scene.groups) add_all(group.objects);
  return keys;
}

}  // namespace raytrace
