// Where what was hit lies for its textures.
#pragma once

#include "raytrace/accel/traced_scene.h"
#include "raytrace/textures/texture_point.h"

namespace raytrace {

/// Of what camera rays of unit length hit; at least one lane must have a hit.
TexturePoint<FloatN> texture_point(const SceneTables& scene, const CameraRays& camera, const Hits& hits,
                                   const SurfaceInteraction<FloatN>& surface);

}  // namespace raytrace
