#include "raytrace/description/scene_layout.h"

#include <algorithm>

#include "raytrace/cameras/registry.h"
#include "raytrace/cameras/view_plane.h"
#include "raytrace/lights/registry.h"
#include "raytrace/materials/registry.h"
#include "raytrace/shapes/registry.h"
#include "raytrace/text/nearest_name.h"
#include "raytrace/text/quoted.h"

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

/// Empty for what the layout does not have.
std::string_view parent_of(std::string_view element, const std::vector<LayoutEntry>& layout) {
  const auto entry = std::find_if(layout.begin(), layout.end(), [&](const auto& e) { return e.element == element; });
  return entry == layout.end() ? std::string_view() : entry->parent;
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

std::string_view meant_element(std::string_view element, std::string_view parent) {
  const std::vector<LayoutEntry> layout = scene_layout();
  std::vector<std::string_view> here, all;
  for (const LayoutEntry& entry : layout) {
    if (entry.element == element) return entry.element;
    if (entry.parent == parent) here.push_back(entry.element);
    all.push_back(entry.element);
  }
  const std::string_view nearest = nearest_name(element, here);
  return nearest.empty() ? nearest_name(element, all) : nearest;
}

bool belongs_to_section(std::string_view element, std::string_view section) {
  const std::vector<LayoutEntry> layout = scene_layout();
  while (!element.empty() && element != section) element = parent_of(element, layout);
  return element == section;
}

std::string explain_misplaced(std::string_view element, std::string_view parent) {
  const std::vector<LayoutEntry> layout = scene_layout();
  const std::string_view meant = meant_element(element, parent);
  const std::string_view place = parent_of(meant, layout);
  if (meant == element && !meant.empty())
    return tag(element) + " does not belong in " + tag(parent) + "; put it into " + tag(place);
  const std::string start = "unknown element " + tag(element) + " in " + tag(parent) + "; ";
  if (meant.empty()) {
    std::vector<std::string_view> here;
    for (const LayoutEntry& entry : layout)
      if (entry.parent == parent) here.push_back(entry.element);
    return start + "it takes " + list_of_tags(here);
  }
  return start + "did you mean " + tag(meant) + (place == parent ? "?" : ", which belongs in " + tag(place) + "?");
}

}  // namespace raytrace
