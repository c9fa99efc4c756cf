// Fogs that fill nothing, and densities that cannot be where they are wanted.
#pragma once

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Warns of each fog of a single object, which has no inside. Several may be the sides
/// of something closed, and a plane has all behind it inside.
/// Refuses what is no density in space: a texture on surfaces, one in a plane's fog, one beside a file.
void check_fogs(const SceneDescription& scene, Diagnostics& diagnostics);

/// What the fog's <density> has as its texture; null: none.
const TextureUse* density_texture(const MaterialItem<Fog>& fog);

/// Refuses instances that move while the shutter is open, with a fog in them that is not the same everywhere.
void check_moving_densities(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace raytrace
