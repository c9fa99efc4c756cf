// What the environment light must keep.
#pragma once

#include <functional>
#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// Calls report(line and column, message) for a second environment light or skylight, and for one whose transform
/// does more than turn and mirror.
void check_environment(const SceneDescription& scene,
                       const std::function<void(SourceLocation, const std::string&)>& report);

}  // namespace raytrace
