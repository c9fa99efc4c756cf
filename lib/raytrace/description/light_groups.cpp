#include "raytrace/description/light_groups.h"

#include <algorithm>
#include <set>
#include <type_traits>

namespace raytrace {

std::vector<std::string> light_group_names(const SceneDescription& description) {
  std::set<std::string> named;
  const auto add_all = [&](const auto& items) {
    for (const auto& item : items) {
      if constexpr (requires { item.parameters.group; }) named.insert(item.parameters.group.name);
      if constexpr (requires { item.parameters.sungroup; }) named.insert(item.parameters.sungroup.name);
    }
  };
  for_each_type(Lights{}, [&]<class Light>(std::type_identity<Light>) {
    add_all(std::get<LightItems<Light>>(description.lights));
  });
  for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
    add_all(std::get<MaterialItems<Material>>(description.materials));
  });
  named.erase("");
  named.erase(std::string(default_light_group));
  std::vector<std::string> names{std::string(default_light_group)};
  names.insert(names.end(), named.begin(), named.end());
  return names;
}

std::size_t find_light_group(const std::vector<std::string>& names, const Reference& group) {
  if (group.name.empty()) return 0;
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), group.name) - names.begin());
}

}  // namespace raytrace
