// Solids of clear material that are hardly meant.
#pragma once

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Of meshes that are loaded, and right. Warns of each closed mesh of clear material whose faces have their fronts
/// inside: rays that come from outside would start within the glass. Not of one within the box of other clear things:
/// it may be the hollow of a bottle.
/// Warns of the first flat one, a pane, that suns and points should shine through, where nothing brings their light.
void check_solids(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace raytrace
