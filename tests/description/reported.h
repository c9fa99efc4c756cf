// What reading a scene text reports, and scene texts to put a fault into.
#pragma once

#include <string>
#include <string_view>

#include "raytrace/description/scene_description.h"

namespace raytrace::test {

/// All that reading the text reports, as it is printed; the file is called "s". Empty: the scene is fine.
std::string reported(const std::string& text);

/// The scene of a text that may have warnings but no error.
SceneDescription accepted(const std::string& text);

/// A scene free of errors, with something more in a line of its own, the second. It has the materials "clay" (matte)
/// and "steel" (phong), but no object.
std::string scene_with(std::string_view more);

/// The same with one sphere; its children stand in the second line.
std::string scene_with_sphere(std::string_view children);

}  // namespace raytrace::test
