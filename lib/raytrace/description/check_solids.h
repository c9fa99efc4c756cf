// Solids of clear material that are hardly meant.
#pragma once

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Meshes must be loaded and valid.
///
/// Warns of each closed mesh of clear material whose faces have their fronts inside: rays that come from outside would
/// start within the glass. Not of one that others may be around, as a bottle is around its hollow.
/// Warns of the first that is flat, such as a pane, where suns and points should shine through and nothing brings their
/// light.
void check_solids(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace raytrace
