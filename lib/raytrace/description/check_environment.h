// What the environment light must keep.
#pragma once

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Reports a second environment light or skylight, and one whose transform does more than turn and mirror.
void check_environment(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace raytrace
