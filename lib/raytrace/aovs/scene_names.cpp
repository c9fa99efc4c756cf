#include "raytrace/aovs/scene_names.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "raytrace/aovs/cryptomatte.h"

namespace raytrace {

std::vector<std::string> object_names(const SceneDescription& description) {
  std::vector<std::string> names;
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    for (const auto& item : std::get<ObjectItems<Shape>>(description.objects)) names.push_back(item.name);
  });
  std::unordered_set<std::uint32_t> taken;
  taken.reserve(names.size());
  for (const std::string& name : names)
    if (!name.empty()) taken.insert(cryptomatte::id_of(name));

  auto name = names.begin();
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    const std::size_t count = std::get<ObjectItems<Shape>>(description.objects).size();
    for (std::size_t number = 1; number <= count; ++number, ++name) {
      if (!name->empty()) continue;
      const std::string usual = std::string(Shape::element) + '#' + std::to_string(number);
      *name = usual;
      for (int i = 2; !taken.insert(cryptomatte::id_of(*name)).second; ++i) *name = usual + '#' + std::to_string(i);
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
