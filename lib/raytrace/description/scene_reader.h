// Reads the text of a scene file, and of those that it includes, into a description.
#pragma once

#include <string>

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/scene_text.h"

namespace raytrace {

struct ReadScene {
  SceneDescription scene;
  bool has_keys = false;  ///< values that change from frame to frame
};

/// The scene as it is at one moment: what could be read of it, where there are errors. file: "" for a text that is not
/// a file's. As load_scene(), which also adds what moves, and the images of textures.
ReadScene read_scene(TextBuffer text, const std::string& file, Diagnostics& diagnostics, int threads,
                     const SceneSettings& settings);

}  // namespace raytrace
