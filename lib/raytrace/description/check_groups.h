// What groups and their instances must keep.
#pragma once

#include <optional>
#include <string>

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Reports each instance of a group that is not there, each plane in a group, each instance that would have its own
/// group in it, and if there would be more instances than a scene may have, those in groups counted each time.
void check_groups(const SceneDescription& scene, Diagnostics& diagnostics);

/// Once meshes have been read: what is wrong if there are more instances than a scene may have, with meshes' copies.
std::optional<std::string> too_many_copies(const SceneDescription& scene);

inline constexpr std::uint64_t most_instances = std::uint64_t{1} << 24U;

}  // namespace raytrace
