// The rules of the scene format, for descriptions that a program has made or changed. load_scene checks by the same.
#pragma once

#include <stdexcept>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// A description that breaks the rules; what() has all errors, one a line.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reports what is wrong: sizes, radii and other numbers out of their ranges, directions of length 0, an eye at the
/// point it looks at, materials without a name, names that are taken, and references to textures and materials that
/// there are not. Items are named by their indices, as in "<sphere> [2]".
void check_scene(const SceneDescription& scene, Diagnostics& diagnostics);

// The same as an exception, a SceneError. Warnings alone throw none.
void require_good_scene(const SceneDescription& scene);
void require_good_viewplane(const ViewPlane& viewplane);

}  // namespace raytrace
