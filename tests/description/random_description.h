// Descriptions made at random from the registries' tables of fields, and their comparison.
#pragma once

#include <random>

#include "raytrace/description/scene_description.h"

namespace raytrace::test {

/// A description of up to 8 things of each type, with values anywhere in their ranges.
SceneDescription random_description(std::mt19937_64& random);

/// Whether all but file and lines is the same, numbers bit for bit.
bool same_scene(const SceneDescription& a, const SceneDescription& b);

}  // namespace raytrace::test
