// A scene's forms alone: its surfaces as if all were of the same clay.
#pragma once

#include <string>
#include <vector>

#include "raytrace/description/read_value.h"
#include "raytrace/description/scene_description.h"

namespace raytrace {

/// Makes all that is opaque matte grey, which reflects a half of the light, whatever its material was: without
/// textures, gloss, coats, metal, what shines through below its surface, normal maps and bumps, so that only geometry
/// is seen. What shines keeps its light, and opacity stays: leaves stay leaves. Clear glass and fogs stay as they are,
/// so that rooms have the light that comes through their windows, and so do the materials with names in `kept`.
///
/// Of a description with the meshes that load_meshes() reads, whose files' materials count as the scene's own. A scene
/// without an integrator has the one from then on that it had with its materials. A message if no material has one of
/// the names; then nothing is changed.
OptionalMessage make_clay(SceneDescription& scene, const std::vector<std::string>& kept = {});

}  // namespace raytrace
