// The files that image textures and lights name.
#pragma once

#include <string_view>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// The hash of an image that could not be read, and need not be.
inline constexpr std::string_view missing_image = "missing";

/// Loads those that have not been loaded. What cannot be read is an error where the scene names it or, where the
/// settings say so, a warning, and magenta; a displacement by it moves nothing. threads: so many at most share the
/// work; 0: all that the machine has. False if there are errors.
bool load_images(SceneDescription& scene, Diagnostics& diagnostics, int threads, const TextureSettings& settings);

}  // namespace raytrace
