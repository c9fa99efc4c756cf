// The density of a file as a model: what `raytrace smoke.vdb` renders.
#pragma once

#include <string>

#include "raytrace/batch/model_scene.h"
#include "raytrace/description/scene_description.h"

namespace raytrace {

/// Whether it is such a file, by its extension: .vdb or .vol.
bool is_smoke(const std::string& file);

/// Adds a fog of the file's density and, as the scene's first mesh, a box around it. The file does not say how thick a
/// density of 1 is: where it is largest, light goes a fiftieth of the box' diagonal on average. Light is scattered
/// often in white smoke, so paths are long. False where it cannot be read, or has nothing that the stage asks of it,
/// which the diagnostics say.
bool add_smoke(SceneDescription& description, const std::string& file, const ModelStage& stage,
               Diagnostics& diagnostics, int threads, const TextureSettings& textures);

}  // namespace raytrace
