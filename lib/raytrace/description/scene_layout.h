// Which elements stand in which: the layout of a scene file above the parameters of its items, from the registries.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "raytrace/description/scene_description.h"

namespace raytrace {

inline constexpr std::string_view root_element = "raytracer";
inline constexpr std::string_view groups_element = "groups", group_element = "group";
inline constexpr std::string_view transform_element = "transform";
inline constexpr std::string_view shadowcatcher_element = "shadowcatcher", visible_element = "visible";
inline constexpr std::string_view integrator_element = "integrator";  ///< holds one of Integrators

// The sections: elements at the root that hold any number of items of the types in a registry. labels: the children
// that items have beside their parameters, which go to the members of these names. may_skip: whether items may be left
// out, with a warning, where their types say so.

struct LightsSection {
  using Types = Lights;
  static constexpr std::string_view element = "lights", item = "light";
  static constexpr auto items = &SceneDescription::lights;
  static constexpr std::array<FieldInfo, 0> labels{};
  static constexpr bool may_skip = true;
};

struct TexturesSection {
  using Types = Textures;
  static constexpr std::string_view element = "textures", item = "texture";
  static constexpr auto items = &SceneDescription::textures;
  static constexpr std::array<FieldInfo, 1> labels{{{"name"}}};
  static constexpr bool may_skip = false;
};

struct MaterialsSection {
  using Types = Materials;
  static constexpr std::string_view element = "materials", item = "material";
  static constexpr auto items = &SceneDescription::materials;
  static constexpr std::array<FieldInfo, 1> labels{{{"name"}}};
  static constexpr bool may_skip = false;
};

struct ObjectsSection {
  using Types = Objects;
  static constexpr std::string_view element = "objects", item = "object";
  static constexpr auto items = &SceneDescription::objects;
  static constexpr std::array<FieldInfo, 5> labels{{{"name", false},
                                                    {"material"},
                                                    {transform_element, false},
                                                    {shadowcatcher_element, false},
                                                    {visible_element, false}}};
  static constexpr bool may_skip = true;
};

/// The labels of a section's items of one type.
template <class Section, class T>
constexpr auto labels_of() {
  if constexpr (requires { T::may_be_turned; }) {
    return std::array<FieldInfo, 1>{{{transform_element, false}}};
  } else if constexpr (requires { T::may_be_moved; }) {
    return std::array<FieldInfo, 2>{{{"name"}, {transform_element, false}}};
  } else {
    auto labels = Section::labels;
    if constexpr (requires { T::may_lack_material; }) labels[1].required = false;
    return labels;
  }
}

using Sections = TypeList<LightsSection, TexturesSection, MaterialsSection, ObjectsSection>;

/// What of a section's items of one type the description has: std::vector<ObjectItem<T>>, say. Scene: a
/// SceneDescription, or a constant one.
template <class Section, class T, class Scene>
auto& items_of(Scene& scene) {
  return std::get<index_of<T>(typename Section::Types{})>(scene.*Section::items);
}

/// visit(std::type_identity<Section>, std::type_identity<T>) for each type of an item, section by section.
template <class Visit>
void for_each_item_type(const Visit& visit) {
  for_each_type(Sections{}, [&](auto section) {
    for_each_type(typename decltype(section)::type::Types{}, [&](auto type) { visit(section, type); });
  });
}

/// visit(std::type_identity<T>, parameters) of the type whose parameters the variant has.
template <class List, class Variant, class Visit>
void visit_one_of(List list, const Variant& parameters, const Visit& visit) {
  with_type(list, parameters.index(),
            [&]<class T>(std::type_identity<T> type) { visit(type, *std::get_if<index_of<T>(List{})>(&parameters)); });
}

/// visit(std::type_identity<T>, parameters) of what a scene has one of: the view plane, the camera and, if there is
/// one, the integrator.
template <class Visit>
void for_each_single(const SceneDescription& scene, const Visit& visit) {
  visit(std::type_identity<ViewPlane>{}, scene.viewplane);
  visit_one_of(Cameras{}, scene.camera, visit);
  if (scene.integrator) visit_one_of(Integrators{}, *scene.integrator, visit);
}

struct LayoutEntry {
  std::string_view element;
  std::string_view parent;
};

/// All sections, groups and items; every element once.
std::vector<LayoutEntry> scene_layout();

/// The elements that hold any number of one type's items, such as <spheres>.
std::vector<std::string_view> group_elements();

/// The elements that stand in that one.
std::vector<std::string_view> elements_in(std::string_view parent);

/// The element of the layout that one in `parent` was most likely meant for: itself, or that of the nearest name; empty
/// if there is none.
std::string_view meant_element(std::string_view element, std::string_view parent);

/// Whether the element of the layout is that section, or stands in it.
bool belongs_to_section(std::string_view element, std::string_view section);

/// The message for an element that does not belong where it stands: where it does, or which name was meant.
std::string explain_misplaced(std::string_view element, std::string_view parent);

}  // namespace raytrace
