// Materials that a scene may have, but whose light is hardly what was meant.
#pragma once

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// Warns of surfaces that reflect more light than they get, of films that are thick enough for nanometres to have been
/// taken for micrometres, and of fog on what has no inside.
void warn_of_materials(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace raytrace
