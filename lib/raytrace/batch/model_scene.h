// A scene around a model's file: what `raytrace model.glb` renders. The file may have cameras and lights of its own.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// How a model is shown. Angles are degrees about its middle: from its front, +z, towards its +x; and above, from -90
/// to 90.
struct ModelStage {
  /// Where it is looked at from, azimuth and elevation; all of it is in view. None: by the file's camera of that name,
  /// or its first if there is no name; where it has none, from (30, 15).
  std::optional<std::array<double, 2>> view;
  std::string camera;
  bool z_is_up = false;     ///< in the model's file; else y is, as glTF has it
  int turntable = 0;        ///< so many frames are a full turn; 0: it stands still. No file's camera then
  std::string variant{};    ///< of the file's materials; empty: those that it has by itself
  std::string animation{};  ///< empty: the first, if there is one
  /// Of its time: frame 1 is its beginning. None: 24; and on a turntable the model stands still, unless an animation
  /// is asked for.
  std::optional<double> frames_per_second{};
  bool fit = false;  ///< moves a camera of the file so that all of the model is just in view, as a view of ours has it
  bool floor = false;  ///< an endless one, which the model stands on

  // In place of the studio, or of the file's lights.
  std::string environment;                   ///< "sky", the file of a picture, or "none": the model's own lights alone
  std::optional<std::array<double, 2>> sun;  ///< where it is, by its angles
};

/// Whether it is one of those files, by its extension: .glb, .gltf, .obj, .ply, .stl, perhaps with .gz behind, or
/// one of converted_types (import/converted_model.h); or a file of densities, .vdb or .vol (model_smoke.h).
bool is_model(const std::string& file);

/// The model in the file's lights and a sky that is dim beside them, exposed by its own brightness since they may be of
/// any; where there are none in a studio, a large soft lamp from the left, a strip behind on the right, and a dim sky,
/// darker below; or in the stage's own light; with 128 samples, shown through the Khronos PBR Neutral
/// Tone Mapper. size: width and height; none: 1280 x 720, or as many pixels in the shape that the file's camera has, if
/// it is the picture's. On a turntable, the studio stays before the camera; a file's camera does not see its lamps.
/// frame: of the film, from 1 on; without one, the model is at rest, or at the beginning of an animation that is asked
/// for. The camera and the studio are the same for all frames. None if it cannot be read, which the diagnostics say.
/// threads: as load_scene()'s.
std::optional<SceneDescription> load_model(const std::string& file, const ModelStage& stage, std::optional<int> frame,
                                           std::optional<std::array<int, 2>> size, Diagnostics& diagnostics,
                                           int threads, const TextureSettings& textures);

}  // namespace raytrace
