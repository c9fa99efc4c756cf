// Light groups: what the lights of a group bring to a picture, a file may hold by itself, as the AOV light_NAME.
//
//   <pointlight> ... <group>key</group> </pointlight>
//
// All lights without a group, and the background, are in the group "default".
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

inline constexpr std::string_view default_light_group = "default";
inline constexpr std::string_view light_aov_prefix = "light_";

/// The field of lights and of materials that shine. Its name is part of channels' names.
template <class Parameters>
Field light_group(std::string_view name = "group", Reference Parameters::* group = &Parameters::group) {
  return optional(name, group, Range::identifier);
}

}  // namespace raytrace
