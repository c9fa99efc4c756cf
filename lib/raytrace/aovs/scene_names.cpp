#include "raytrace/aovs/scene_names.h"

#include <nlohmann/json.hpp>

namespace raytrace {

std::vector<std::string> object_names(const SceneDescription& description) {
  std::vector<std::string> names;
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    std::size_t number = 0;
    for (const auto& item : std::get<ObjectItems<Shape>>(description.objects)) {
      ++number;
      names.push_back(item.name.empty() ? std::string(Shape::element) + '#' + std::to_string(number) : item.name);
    }
  });
  return names;
}

std::vector<std::string> material_names(const SceneDescription& description) {
  std::vector<std::string> names;
  for_each_type(Materials{}, [&](auto type) {
    using Material = typename decltype(type)::type;
    for (const auto& item : std::get<MaterialItems<Material>>(description.materials)) names.push_back(item.name);
  });
  return names;
}

ImageAttribute id_manifest(std::string_view channel, const std::vector<std::string>& names) {
  return {"raytrace:manifest/" + std::string(channel),
          nlohmann::json(names).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

}  // namespace raytrace
