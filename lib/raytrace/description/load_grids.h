// Reads the files of fogs' densities.
#pragma once

#include <functional>
#include <string>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/bounds.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Each file once. hash_of(file): of its bytes; throws PictureError where it cannot be read. What is wrong with the
/// files goes to `diagnostics`, at their names; false if there is an error.
bool load_grids(SceneDescription& scene, Diagnostics& diagnostics, int threads,
                const std::function<std::string(const std::string& file)>& hash_of);

/// Where a fog whose grid is loaded has any density, with its transform.
Bounds grid_bounds(const MaterialItem<Fog>& fog);

}  // namespace raytrace
