// Finer faces in place of a mesh's own, and their displacement by a texture.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// visit(use) for the texture of each displacement of meshes and models.
template <class Visit>
void for_each_displacement(const SceneDescription& scene, const Visit& visit) {
  const auto visit_all = [&](const auto& items) {
    for (const auto& item : items)
      for (const TextureUse& use : item.textures) visit(use);
  };
  const auto visit_lists = [&](const ObjectLists& objects) {
    visit_all(std::get<ObjectItems<Mesh>>(objects));
    visit_all(std::get<ObjectItems<Model>>(objects));
  };
  visit_lists(scene.objects);
  for (const Group& group : scene.groups) visit_lists(group.objects);
}

/// The field of the displacement, for a TextureUse of a Mesh or a Model.
template <class Object>
std::uint32_t displacement_use_field() {
  const Fields& fields = element_type<Object>().fields;
  std::uint32_t i = 0;
  while (fields[i].name != displacement_field) ++i;
  return i;
}

/// Meshes of the same data that want the same are made once.
class MeshRefiner {
 public:
  /// scene: has its textures, loaded.
  MeshRefiner(const SceneDescription& scene, Diagnostics& diagnostics, int threads)
      : scene_(scene), diagnostics_(diagnostics), threads_(threads) {}

  /// The data as the mesh wants them; the same where it wants nothing. Null, with an error, where that is not possible.
  std::shared_ptr<const MeshData> refined(const ObjectItem<Mesh>& mesh, const std::shared_ptr<const MeshData>& data);

 private:
  static constexpr std::uint32_t no_texture = 0xffffffff;
  struct Key {
    std::shared_ptr<const MeshData> data;
    int levels;
    bool flat;
    bool has_normals;  ///< whether its normals are those of the data, or what takes their place
    std::uint32_t texture_type, texture;
    TextureChannel channel;
    double height, midlevel;

    bool is_displaced() const { return texture_type != no_texture; }

    auto operator<=>(const Key&) const = default;
  };

  /// A mesh without its copies. fault: why it cannot be, if it cannot.
  MeshData finer(const MeshData& data, const Key& key, std::optional<std::string>& fault) const;

  const SceneDescription& scene_;
  Diagnostics& diagnostics_;
  int threads_;
  std::map<Key, std::shared_ptr<const MeshData>> made_;
};

}  // namespace raytrace
