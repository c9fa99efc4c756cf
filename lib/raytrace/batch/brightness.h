// What there is to say of a finished picture's brightness: that it is black, and why; that only another exposure shows
// it.
#pragma once

#include <optional>
#include <string>

#include "raytrace/description/scene_description.h"
#include "raytrace/film/film.h"
#include "raytrace/scene/scene.h"

namespace raytrace {

/// Of a scene in which nothing shines, neither lights nor materials nor the background, whose light is computed: it
/// will be black. Known before a ray is traced.
std::optional<std::string> no_light_warning(const SceneDescription& description);

/// How a whole picture is shown.
struct ShownAs {
  double exposure = 0;  ///< in stops
  bool clips = true;    ///< what is brighter than white is shown as white (ViewTransform::srgb)
};

/// Why a whole picture is black, of a scene that no_light_warning() says nothing of; or that it is much brighter or
/// darker than what is shown, with the exposure that shows it. Of a black one it renders a sample per pixel, to know
/// whether an object is in view. A transparent picture may be black where shadows are all that it shows.
///   shown: none if no file is for display, or if the picture's own brightness sets the exposure
std::optional<std::string> brightness_warning(const Film& film, const Scene& scene, const SceneDescription& description,
                                              const std::optional<ShownAs>& shown);

}  // namespace raytrace
