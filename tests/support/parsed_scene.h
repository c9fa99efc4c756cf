// Scene texts of tests, which must be free of errors.
#pragma once

#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace::test {

/// The text as a description; std::runtime_error with all that is wrong with it otherwise.
SceneDescription parsed_scene(const std::string& text);

}  // namespace raytrace::test
