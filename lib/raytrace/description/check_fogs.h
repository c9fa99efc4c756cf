// Fogs that fill nothing.
#pragma once

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Warns of each fog of a single object, which has no inside. Several may be the sides
/// of something closed, and a plane has all behind it inside.
void check_fogs(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace raytrace
