// A scene around a model's file, which has neither a camera nor lights that are read: what `raytrace model.glb`
// renders.
#pragma once

#include <optional>
#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// Where a model is looked at from: degrees about its middle. All of it is in view.
struct ModelView {
  double azimuth = 30;    ///< from its front, +z, towards its +x
  double elevation = 15;  ///< above, from -90 to 90
  bool z_is_up = false;   ///< in the model's file; else y is, as glTF has it
};

/// Whether it is one of those files, by its extension: .glb, .gltf, .obj, .ply, .stl.
bool is_model(const std::string& file);

/// The model in a studio: a large soft lamp from the left, a strip behind on the right, and an even dim sky; width x
/// height pixels, 128 samples. None if it cannot be read, which the diagnostics say. threads: as load_scene()'s.
std::optional<SceneDescription> load_model(const std::string& file, const ModelView& view, int width, int height,
                                           Diagnostics& diagnostics, int threads, MissingTexture missing_texture);

}  // namespace raytrace
