#include "raytrace/description/scene_layout.h"

#include <algorithm>
#include <iterator>

#include "raytrace/description/include.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace {

/// Empty for what the layout does not have.
std::string_view parent_of(std::string_view element) {
  const std::vector<LayoutEntry> layout = scene_layout();
  const auto entry = std::find_if(layout.begin(), layout.end(), [&](const auto& e) { return e.element == element; });
  return entry == layout.end() ? std::string_view() : entry->parent;
}

/// Names of other programs, and the element that does it here.
struct ElementHint {
  std::string_view name, element;
  std::string_view note{};  ///< what else there is to know
};
constexpr std::string_view of_area_lights = " (a light with a size is an object of that material)";
constexpr ElementHint element_hints[] = {
    {"sun", "directionallight", " (a <skylight> has a sun, too)"},
    {"sunlight", "directionallight", " (a <skylight> has a sun, too)"},
    {"distantlight", "directionallight"},
    {"arealight", "emissive", of_area_lights},
    {"arealights", "emissives", of_area_lights},
    {"glass", "dielectric"},
    {"metal", "conductor"},
    {"principled", "openpbr"},
    {"plastic", "openpbr"},
};

const ElementHint* find_element_hint(std::string_view name) {
  const auto* const found = std::find_if(std::begin(element_hints), std::end(element_hints),
                                         [&](const ElementHint& hint) { return hint.name == name; });
  return found == std::end(element_hints) ? nullptr : found;
}

}  // namespace

std::vector<LayoutEntry> scene_layout() {
  std::vector<LayoutEntry> layout{{ViewPlane::element, root_element}};
  for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) { layout.push_back({T::element, root_element}); });
  layout.push_back({integrator_element, root_element});
  layout.push_back({Include::element, root_element});
  for_each_type(Integrators{},
                [&]<class T>(std::type_identity<T>) { layout.push_back({T::element, integrator_element}); });
  for_each_type(Sections{}, [&]<class Section>(std::type_identity<Section>) {
    layout.push_back({Section::element, root_element});
    for_each_type(typename Section::Types{}, [&]<class T>(std::type_identity<T>) {
      if (!T::group.empty()) layout.push_back({T::group, Section::element});
      layout.push_back({T::element, T::group.empty() ? Section::element : T::group});
    });
  });
  layout.push_back({groups_element, root_element});
  layout.push_back({group_element, groups_element});
  return layout;
}

std::vector<std::string_view> group_elements() {
  std::vector<std::string_view> groups;
  for_each_item_type([&]<class T>(auto, std::type_identity<T>) {
    if (!T::group.empty()) groups.push_back(T::group);
  });
  return groups;
}

std::vector<std::string_view> elements_in(std::string_view parent) {
  std::vector<std::string_view> elements;
  for (const LayoutEntry& entry : scene_layout())
    if (entry.parent == parent) elements.push_back(entry.element);
  if (parent == group_element) elements.insert(elements.end(), {"name", ObjectsSection::element});
  return elements;
}

std::string_view meant_element(std::string_view element, std::string_view parent) {
  std::vector<std::string_view> all;
  for (const LayoutEntry& entry : scene_layout()) {
    if (entry.element == element) return entry.element;
    all.push_back(entry.element);
  }
  if (const ElementHint* const hint = find_element_hint(element)) return hint->element;
  const std::string_view nearest = nearest_name(element, elements_in(parent));
  return nearest.empty() ? nearest_name(element, all) : nearest;
}

bool belongs_to_section(std::string_view element, std::string_view section) {
  while (!element.empty() && element != section) element = parent_of(element);
  return element == section;
}

std::string explain_misplaced(std::string_view element, std::string_view parent) {
  const std::string_view meant = meant_element(element, parent);
  const std::string_view home = parent_of(meant);
  if (meant == element && !meant.empty())
    return tag(element) + " does not belong in " + tag(parent) + "; put it into " + tag(home);
  const std::string start = "unknown element " + tag(element) + " in " + tag(parent) + "; ";
  if (meant.empty()) return start + "it takes " + list_of_tags(elements_in(parent));
  const ElementHint* const hint = find_element_hint(element);
  return start + "did you mean " + tag(meant) + (home == parent ? "?" : ", which belongs in " + tag(home) + "?") +
         std::string(hint != nullptr ? hint->note : "");
}

}  // namespace raytrace
