// The light groups of a scene (parameters/light_group.h).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// "default", and after it those that lights and materials name, in alphabetical order.
std::vector<std::string> light_group_names(const SceneDescription& description);

/// The place among them of the group that a field names.
std::size_t find_light_group(const std::vector<std::string>& names, const Reference& group);

}  // namespace raytrace
