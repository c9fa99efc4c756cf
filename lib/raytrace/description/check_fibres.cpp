#include "raytrace/description/check_fibres.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// A material of fibres.
struct FibreMaterial {
  std::string_view element, name;
};
/// No value of others.
std::optional<FibreMaterial> fibre_material(const SceneDescription& scene, const MaterialReference& material) {
  std::optional<FibreMaterial> result;
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    if constexpr (requires { requires T::is_fibre; }) {
      const auto& items = std::get<MaterialItems<T>>(scene.materials);
      if (material.type == index_of<T>(Materials{}) && material.index < items.size())
        result = {T::element, items[material.index].name};
    }
  });
  return result;
}

class FibreChecker {
 public:
  FibreChecker(const SceneDescription& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  void check(const ObjectLists& objects) {
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      for (const auto& item : std::get<ObjectItems<T>>(objects)) {
        if constexpr (std::is_same_v<T, Instance>) {
          const std::string_view other = other_than_curve(item.parameters.group.name);
          if (!other.empty()) refuse(item, item.material, "this instance gives it to a " + tag(other));
        } else if constexpr (!std::is_same_v<T, Curve>) {
          const std::string why = "this is a " + tag(T::element);
          if (refuse(item, item.material, why)) continue;
          if constexpr (requires { item.materials; })
            for (const MaterialReference& material : item.materials)
              if (refuse(item, material, why)) break;
        }
      }
    });
  }

 private:
  template <class Item>
  bool refuse(const Item& item, const MaterialReference& material, const std::string& why) {
    const std::optional<FibreMaterial> fibre = fibre_material(scene_, material);
    if (!fibre) return false;
    diagnostics_.error(location_of(item), "the material " + in_quotes(fibre->name) + " is a " + tag(fibre->element) +
                                              ", of which only the fibres of a <curve> are; " + why);
    return true;
  }

  /// The element of an object in the group, or in groups of its instances, that is no curve; none: all are.
  std::string_view other_than_curve(const std::string& name) {
    const auto [known, is_new] = known_.try_emplace(name);
    if (!is_new) return known->second;
    std::string_view other;
    for (const Group& group : scene_.groups) {
      if (group.name != name) continue;
      for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
        for (const auto& item : std::get<ObjectItems<T>>(group.objects)) {
          if (!other.empty() || std::is_same_v<T, Curve>) return;
          if constexpr (std::is_same_v<T, Instance>)
            other = other_than_curve(item.parameters.group.name);
          else
            other = T::element;
        }
      });
    }
    return known_[name] = other;
  }

  const SceneDescription& scene_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::string_view> known_;
};

}  // namespace

void check_fibres(const SceneDescription& scene, Diagnostics& diagnostics) {
  bool any = false;
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    if constexpr (requires { requires T::is_fibre; }) any |= !std::get<MaterialItems<T>>(scene.materials).empty();
  });
  if (!any) return;
  FibreChecker checker(scene, diagnostics);
  checker.check(scene.objects);
  for (const Group& group : scene.groups) checker.check(group.objects);
}

}  // namespace raytrace
