// The files that image textures name.
#pragma once

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// Loads the files of all images that have not been loaded, relative to the folder of the scene's own file. What cannot
/// be read is an error in the line of its image or, where `missing` says so, a warning, and magenta. threads: so many
/// at most share the work; 0: all that the machine has. False if there are errors.
bool load_images(SceneDescription& scene, Diagnostics& diagnostics, int threads, MissingTexture missing);

}  // namespace raytrace
