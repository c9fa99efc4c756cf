// Reads the text of a scene file, and of those that it includes, into a description.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/scene_text.h"

namespace raytrace {

/// The elements of objects of types that may have keys somewhere in the scene.
using KeyedObjects = std::set<std::string_view>;

struct ReadScene {
  SceneDescription scene;
  bool has_keys = false;  ///< values that change from frame to frame
  KeyedObjects keyed{};   ///< the objects that may have any, if the scene has
};

/// The scene as it is at one moment: what could be read of it, where there are errors. file: "" for a text that is not
/// a file's. only: objects of other types are left out, as where the scene is read again; null: none are. As
/// load_scene(), which also adds what moves, and the images of textures.
ReadScene read_scene(TextBuffer text, const std::string& file, Diagnostics& diagnostics, int threads,
                     const SceneSettings& settings, const KeyedObjects* only = nullptr);

}  // namespace raytrace
