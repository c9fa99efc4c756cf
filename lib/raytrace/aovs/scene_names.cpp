#include "raytrace/aovs/scene_names.h"

namespace raytrace {

std::vector<std::string> object_names(const SceneDescription& description) {
  std::vector<std::string> names;
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    std::size_t place = 0;
    for (const auto& item : std::get<ObjectItems<Shape>>(description.objects)) {
      ++place;
      names.push_back(item.name.empty() ? std::string(Shape::element) + '#' + std::to_string(place) : item.name);
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

}  // namespace raytrace
