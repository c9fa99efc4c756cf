// Where what was hit lies for its textures.
#pragma once

#include "raytrace/accel/traced_scene.h"
#include "raytrace/textures/texture_point.h"

namespace raytrace {

/// Of what rays of unit length hit, which cover a circle of that radius there; at least one lane must have a hit.
TexturePoint<FloatN> texture_point(const SceneTables& scene, const FloatN& radius, const Hits& hits,
                                   const SurfaceInteraction<FloatN>& surface);
/// The radius of what camera rays cover where they end.
inline FloatN camera_radius(const SceneTables& scene, const CameraRays& camera) {
  return scene.ray_cone().half_width(camera.skipped + camera.rays.far);
}

/// The same of camera rays.
inline TexturePoint<FloatN> texture_point(const SceneTables& scene, const CameraRays& camera, const Hits& hits,
                                          const SurfaceInteraction<FloatN>& surface) {
  return texture_point(scene, camera_radius(scene, camera), hits, surface);
}

}  // namespace raytrace
