#include "raytrace/description/check_fogs.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/text/message.h"

namespace raytrace {

const TextureUse* density_texture(const MaterialItem<Fog>& fog) {
  for (const TextureUse& use : fog.textures)
    if (element_type<Fog>().fields[use.field].name == Fog::density_field) return &use;
  return nullptr;
}

namespace {

/// The objects that a fog is in.
struct FogObjects {
  std::size_t count = 0;
  // Of the last:
  bool is_open = false;
  SourceLocation location{};
  std::string advice{};
};

template <class T>
void add_to_fog(FogObjects& objects, const ObjectItem<T>& item) {
  ++objects.count;
  objects.is_open = false;
  if constexpr (requires { T::is_open(item.parameters); }) {
    objects.is_open = T::is_open(item.parameters);
    if (!objects.is_open) return;
    objects.location = location_of(item);
    objects.advice = "a <fog> in a " + tag(T::element) + ", which has no inside; ";
    if constexpr (requires { item.parameters.caps; })
      objects.advice += "close it by <caps>true</caps>";
    else
      objects.advice += "put it into a closed object, such as a <box>";
  }
}

bool has_density(const MaterialItem<Fog>& fog) {
  return density_texture(fog) != nullptr || !fog.parameters.densityfile.path.empty();
}

/// Why the texture is no density, and what to do; empty: it is one.
std::string wrong_with_density(const SceneDescription& scene, const TextureReference& texture) {
  return with_type(Textures{}, texture.type, [&]<class T>(std::type_identity<T>) -> std::string {
    const auto& items = std::get<TextureItems<T>>(scene.textures);
    if (texture.index >= items.size()) return {};
    const auto& parameters = items[texture.index].parameters;
    if constexpr (requires { parameters.space; }) {
      if constexpr (requires { parameters.uvscale; })
        if (parameters.scale == 0)
          return "a " + tag(T::element) + " without a <scale>, which is on surfaces; give it one";
      if (parameters.space == TextureSpace::object)
        return "a " + tag(T::element) + " with a <space>; remove that, since a density moves with its fog's group";
      return {};
    } else {
      return "a texture on surfaces, " + tag(T::element) + "; take one in space, such as a <noise>, or a <densityfile>";
    }
  });
}

void check_density(const SceneDescription& scene, const MaterialItem<Fog>& fog, Diagnostics& diagnostics) {
  const TextureUse* const texture = density_texture(fog);
  const bool has_file = !fog.parameters.densityfile.path.empty();
  const auto error = [&](const std::string& message) {
    diagnostics.error(location_of(fog), "the fog " + in_quotes(fog.name) + ": " + message);
  };
  if (texture != nullptr && has_file) error("its <density> has a texture beside a <densityfile>; remove one of them");
  if (texture != nullptr)
    if (const std::string wrong = wrong_with_density(scene, texture->texture); !wrong.empty())
      error("its <density> has " + wrong);
  if (length(fog.parameters.densityfade) > 0 && texture == nullptr)
    error("<densityfade> is for a <density> with a texture; it has none");
  if (!fog.transform.empty() && !has_density(fog))
    error(
        "its <transform> moves nothing, since it has neither a <densityfile> nor a <density> with a texture; move the "
        "object");
}

/// Whether the material is a fog that is not the same everywhere.
bool is_uneven(const SceneDescription& scene, const MaterialReference& material) {
  const auto& fogs = std::get<MaterialItems<Fog>>(scene.materials);
  return material.type == index_of<Fog>(Materials{}) && material.index < fogs.size() &&
         has_density(fogs[material.index]);
}

/// Whether one of those objects, or of groups that are in them, has such a fog.
class UnevenGroups {
 public:
  explicit UnevenGroups(const SceneDescription& scene) : scene_(scene) {}

  bool has(const ObjectItem<Instance>& instance) {
    if (!(instance.material == no_material)) return is_uneven(scene_, instance.material);
    for (const Group& group : scene_.groups)
      if (group.name == instance.parameters.group.name) {
        const auto [known, is_new] = known_.try_emplace(group.name, false);
        if (is_new) known->second = has(group.objects);
        return known_[group.name];
      }
    return false;
  }

  /// The element that moves: what is no instance in the scene's file is in a group of its own, at the same place.
  std::string_view moved_element(const ObjectItem<Instance>& instance) const {
    std::string_view element = Instance::element;
    for (const Group& group : scene_.groups) {
      if (group.name != instance.parameters.group.name || group.line != instance.line ||
          group.column != instance.column)
        continue;
      for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
        if (!std::get<ObjectItems<T>>(group.objects).empty()) element = T::element;
      });
    }
    return element;
  }

 private:
  bool has(const ObjectLists& objects) {
    bool any = false;
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      for (const auto& item : std::get<ObjectItems<T>>(objects)) {
        if constexpr (std::is_same_v<T, Instance>)
          any = any || has(item);
        else
          any = any || is_uneven(scene_, item.material);
      }
    });
    return any;
  }

  const SceneDescription& scene_;
  std::map<std::string_view, bool> known_;
};

}  // namespace

void check_moving_densities(const SceneDescription& scene, Diagnostics& diagnostics) {
  UnevenGroups groups(scene);
  const auto check = [&](const ObjectLists& objects) {
    for (const auto& instance : std::get<ObjectItems<Instance>>(objects))
      if (!instance.motion.empty() && groups.has(instance))
        diagnostics.error(
            location_of(instance),
            "this " + tag(groups.moved_element(instance)) +
                " moves while the shutter is open, and its fog has a density that is not the same everywhere; such a "
                "fog may move from picture to picture alone: keep the shutter closed, or the object still");
  };
  check(scene.objects);
  for (const Group& group : scene.groups) check(group.objects);
}

void check_fogs(const SceneDescription& scene, Diagnostics& diagnostics) {
  std::vector<FogObjects> fogs(std::get<MaterialItems<Fog>>(scene.materials).size());
  if (fogs.empty()) return;
  for (const auto& fog : std::get<MaterialItems<Fog>>(scene.materials)) check_density(scene, fog, diagnostics);
  const auto& all = std::get<MaterialItems<Fog>>(scene.materials);
  for (const auto& plane : std::get<ObjectItems<Plane>>(scene.objects))
    if (is_uneven(scene, plane.material) && density_texture(all[plane.material.index]) != nullptr)
      diagnostics.error(location_of(plane),
                        std::string("the fog of a plane has no end, and a density that is a texture needs one; put the "
                                    "fog into a closed object, such as a <box>"));
  const auto add = [&](const ObjectLists& lists, bool in_group) {
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      for (const auto& item : std::get<ObjectItems<T>>(lists))
        if (item.material.type == index_of<Fog>(Materials{}) && item.material.index < fogs.size())
          for (int i = 0; i < (in_group ? 2 : 1); ++i) add_to_fog(fogs[item.material.index], item);
    });
  };
  add(scene.objects, false);
  for (const Group& group : scene.groups) add(group.objects, true);  // which may have several instances
  for (const FogObjects& objects : fogs)
    if (objects.count == 1 && objects.is_open) diagnostics.warning(objects.location, objects.advice);
}

}  // namespace raytrace
