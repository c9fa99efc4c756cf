// What moves while the camera's shutter is open.
//
// The scene is read once more for each of some moments from the opening of the shutter to its closing. Where keys give
// other values there, the camera has its parameters, and an object its transform, at each moment; between two moments
// all move straight on. An object that moves becomes an instance of a group of its own, so that instances are all that
// moves behind this. A shutter that opens and closes at one moment shows all as it stands then.
#pragma once

#include <functional>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// So many moments: the first when the shutter opens, the last when it closes, at even distances. A turn by 90 degrees
/// between them is followed to a thousandth of its radius.
inline constexpr int shutter_moments = 17;

/// Whether the shutter opens and closes at one moment that is not the frame.
bool is_open_for_an_instant(const SceneDescription& scene);

/// Adds what moves to the scene, if its camera's shutter is open for some time; for an instant, camera and objects are
/// as they are then. read(after_frame, diagnostics): what the scene's file says so many frames after the scene's. An
/// object that moves by its own numbers must keep its form and size, or it is an error, as are objects that are not
/// there all the time. Keys of other things than the camera and objects are a warning: those stay as they are at the
/// frame; so do the animations of files.
void add_motion(SceneDescription& scene,
                const std::function<SceneDescription(double after_frame, Diagnostics& diagnostics)>& read,
                Diagnostics& diagnostics);

/// For a scene that is to stand still: warns if its shutter is open for some time.
void warn_of_motion(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace raytrace
