// What the objects and materials of a scene are called where a picture has ids of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// In the order that objects are counted in: type by type as in the Shapes registry, each type's as the file has them.
/// An object without a name is called by its type and its number among that type's, counted from 1: "sphere#12"; or,
/// where another object is called so, or has the Cryptomatte id of that name, "sphere#12#2", "sphere#12#3"...
std::vector<std::string> object_names(const SceneDescription& description);

/// Type by type as in the Materials registry, each type's as the file has them.
std::vector<std::string> material_names(const SceneDescription& description);

/// The names of a channel's ids as an attribute of the picture, "raytrace:manifest/id.object": a JSON array, the name
/// of id 1 first.
ImageAttribute id_manifest(std::string_view channel, const std::vector<std::string>& names);

}  // namespace raytrace
