// Where what was hit lies for its textures.
#pragma once

#include <optional>

#include "raytrace/accel/traced_scene.h"
#include "raytrace/textures/texture_point.h"

namespace raytrace {

/// Of what rays of unit length hit, which cover a circle of that radius there; at least one lane must have a hit.
TexturePoint<FloatN> texture_point(const SceneTables& scene, const FloatN& radius, const Hits& hits,
                                   const SurfaceInteraction<FloatN>& surface);
/// The same for a texture that is looked up by those coordinates alone, where rays cover nothing of what they hit,
/// which is all of one geometry. In a fraction of the time; none of what has no such coordinates at vertices.
std::optional<TexturePoint<FloatN>> texture_point_of_coordinates(const SceneTables& scene, const Hits& hits, UvSet set);
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
