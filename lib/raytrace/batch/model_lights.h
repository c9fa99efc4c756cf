// The light in which a model stands.
#pragma once

#include <optional>
#include <string_view>

#include "raytrace/batch/model_extent.h"
#include "raytrace/batch/model_scene.h"

namespace raytrace {

/// A ModelStage::environment that is no file.
inline constexpr std::string_view sky_environment = "sky", no_environment = "none";

/// As the stage says: a sky or picture with its sun; else the file's lights and a sky that is dim beside them; else a
/// studio, whose lamps stand about that extent of the picture, or are suns where there is none: a camera of the file
/// might see them. Its pictures are exposed by their own brightness where that may be any. shown: the model at all
/// times that it is shown at.
void add_model_lights(SceneDescription& description, const SceneDescription& shown, const ModelStage& stage,
                      const Directions& to, const std::optional<Extent>& extent);

}  // namespace raytrace
