// The lights that a model's file has.
#pragma once

#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/affine.h"

namespace raytrace {

/// Adds them to the scene's, moved by the transform. They shine as brightly at every scale.
void add_file_lights(const std::vector<FileLight>& lights, const Affine& transform, SceneDescription& description);

}  // namespace raytrace
