// Fogs that fill nothing.
#pragma once

#include <functional>
#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// Calls warn(line and column, message) for each fog of a single object, which has no inside. Several may be the sides
/// of something closed, and a plane has all behind it inside.
void check_fogs(const SceneDescription& scene, const std::function<void(SourceLocation, const std::string&)>& warn);

}  // namespace raytrace
