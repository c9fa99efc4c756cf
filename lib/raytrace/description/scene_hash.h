// A fingerprint of what a scene looks like.
#pragma once

#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// 32 hexadecimal digits (XXH3, 128 bits) of all names and values of the description but the number of samples and
/// where in which file they stood: two files that mean the same have the same.
std::string scene_hash(const SceneDescription& description);

}  // namespace raytrace
