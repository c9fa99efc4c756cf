// What meshes and models read of their files.
#pragma once

#include <compare>
#include <set>
#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// What is the same for several meshes is read once.
struct MeshFileKey {
  std::string file, animation;
  double time;
  std::string variant;
  bool overrides_materials;
  bool has_polygons, is_joined;  ///< as MeshReadSettings has both

  auto operator<=>(const MeshFileKey&) const = default;
};

/// Of a mesh or a model.
template <class Item>
MeshFileKey key_of(const Item& item) {
  const auto& parameters = item.parameters;
  const std::string& animation = parameters.animation.name;
  const bool is_subdivided = parameters.subdivision > 0, is_displaced = !item.textures.empty();
  // The time is of an animation alone.
  return {parameters.file.path,
          animation,
          animation.empty() ? 0 : parameters.time,
          parameters.variant.name,
          parameters.overridematerials,
          is_subdivided,
          is_subdivided || is_displaced};
}

/// Those of which something in the scene has the materials of the file.
inline std::set<MeshFileKey> files_with_shown_materials(const SceneDescription& scene) {
  std::set<MeshFileKey> keys;
  const auto add = [&](const auto& items) {
    for (const auto& item : items)
      if (item.material == no_material) keys.insert(key_of(item));
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
