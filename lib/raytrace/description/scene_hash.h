// A fingerprint of what a scene looks like.
#pragma once

#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// 32 hexadecimal digits (XXH3, 128 bits) of all names and values of the description but the number of samples and
/// where in which file they stood: two files that mean the same have the same. threads: so many at most share the work;
/// 0: all that the machine has.
std::string scene_hash(const SceneDescription& description, int threads = 0);

}  // namespace raytrace
