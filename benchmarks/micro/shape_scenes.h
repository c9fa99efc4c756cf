// One object of each shape, for its intersection to be timed alone.
#pragma once

#include <vector>

#include "raytrace/description/scene_description.h"

namespace raytrace::benchmark {

struct ShapeScene {
  std::string shape;  ///< the element's name in a scene file
  SceneDescription description;
};

/// The objects stand about the origin and reach about 1 to each side. A shape that is not among them is not timed.
std::vector<ShapeScene> shape_scenes();

}  // namespace raytrace::benchmark
