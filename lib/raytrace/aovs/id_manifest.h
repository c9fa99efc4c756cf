// What the ids of an id channel stand for, as an attribute of the picture.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "raytrace/aovs/scene_names.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// "raytrace:manifest/id.object": a JSON array of the names, that of id 1 first.
ImageAttribute id_manifest(std::string_view channel, const std::vector<std::string>& names);

}  // namespace raytrace
