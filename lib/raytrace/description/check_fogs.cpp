#include "raytrace/description/check_fogs.h"

#include <vector>

#include "raytrace/text/message.h"

namespace raytrace {

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

}  // namespace

void check_fogs(const SceneDescription& scene, Diagnostics& diagnostics) {
  std::vector<FogObjects> fogs(std::get<MaterialItems<Fog>>(scene.materials).size());
  if (fogs.empty()) return;
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
