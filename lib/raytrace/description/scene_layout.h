// Which elements stand in which: the frame of a scene file above the parameters of its items, drawn from the
// registries.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raytrace {

inline constexpr std::string_view root_element = "raytracer";
inline constexpr std::string_view lights_element = "lights";
inline constexpr std::string_view materials_element = "materials";
inline constexpr std::string_view objects_element = "objects";

struct LayoutEntry {
  std::string_view element;
  std::string_view parent;
};

/// All sections, groups and items; every element once.
std::vector<LayoutEntry> scene_layout();

/// The elements that hold any number of one type's items, such as <spheres>.
std::vector<std::string_view> group_elements();

/// The element of the layout that one in `parent` was most likely meant for: itself, or that of the nearest name; empty
/// if there is none.
std::string_view meant_element(std::string_view element, std::string_view parent);

/// Whether the element of the layout is that section, or stands in it.
bool belongs_to_section(std::string_view element, std::string_view section);

/// The message for an element that does not belong where it stands: where it does, or which name was meant.
std::string explain_misplaced(std::string_view element, std::string_view parent);

}  // namespace raytrace
