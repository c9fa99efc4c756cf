#include "raytrace/description/scene_layout.h"

#include <algorithm>

#include "raytrace/cameras/registry.h"
#include "raytrace/description/nearest_name.h"
#include "raytrace/description/quoted.h"
#include "raytrace/description/view_plane.h"
#include "raytrace/lights/registry.h"
#include "raytrace/materials/registry.h"
#include "raytrace/shapes/registry.h"

namespace raytrace {
namespace {

template <class List>
void add_section(std::vector<LayoutEntry>& layout, std::string_view section, List list) {
  layout.push_back({section, root_element});
  for_each_type(list, [&]<class T>(std::type_identity<T>) {
    if (!T::group.empty()) layout.push_back({T::group, section});
    layout.push_back({T::element, T::group.empty() ? section : T::group});
  });
}

template <class List>
void add_groups(std::vector<std::string_view>& groups, List list) {
  for_each_type(list, [&]<class T>(std::type_identity<T>) {
    if (!T::group.empty()) groups.push_back(T::group);
  });
}

}  // namespace

std::vector<LayoutEntry> scene_layout() {
  std::vector<LayoutEntry> layout{{ViewPlane::element, root_element}};
  for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) { layout.push_back({T::element, root_element}); });
  add_section(layout, lights_element, Lights{});
  add_section(layout, materials_element, Materials{});
  add_section(layout, objects_element, Shapes{});
  return layout;
}

std::vector<std::string_view> group_elements() {
  std::vector<std::string_view> groups;
  add_groups(groups, Lights{});
  add_groups(groups, Materials{});
  add_groups(groups, Shapes{});
  return groups;
}

std::string explain_misplaced(std::string_view element, std::string_view parent) {
  const std::vector<LayoutEntry> layout = scene_layout();
  const auto find = [&](std::string_view name) {
    return std::find_if(layout.begin(), layout.end(), [&](const LayoutEntry& entry) { return entry.element == name; });
  };
  if (const auto known = find(element); known != layout.end()) {
    return tag(element) + " does not belong in " + tag(parent) + "; put it into " + tag(known->parent);
  }

  const std::string start = "unknown element " + tag(element) + " in " + tag(parent) + "; ";
  std::vector<std::string_view> here, all;
  for (const LayoutEntry& entry : layout) {
    if (entry.parent == parent) here.push_back(entry.element);
    all.push_back(entry.element);
  }
  if (const std::string_view nearest = nearest_name(element, here); !nearest.empty()) {
    return start + "did you mean " + tag(nearest) + "?";
  }
  if (const std::string_view nearest = nearest_name(element, all); !nearest.empty()) {
    return start + "did you mean " + tag(nearest) + ", which belongs in " + tag(find(nearest)->parent) + "?";
  }
  return start + "it takes " + list_of_tags(here);
}

}  // namespace raytrace
