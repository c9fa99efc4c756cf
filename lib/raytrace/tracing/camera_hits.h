// What camera rays hit.
#pragma once

#include "raytrace/accel/traced_scene.h"
#include "raytrace/tracing/identified_rays.h"
#include "raytrace/tracing/shadow_catcher.h"

namespace raytrace {

/// Ends the rays at their nearest hits. Those of a camera that is far away start anew from the eye where they hit
/// something that is closer to it than to where they started: floats are more precise there.
RAYTRACE_INLINE Hits nearest_camera_hits(const TracedScene& scene, CameraRays& camera, const MaskN& active) {
  Ray<FloatN>& rays = camera.rays;
  const auto intersect = [&](Ray<FloatN>& some, const MaskN& lanes, const DirectionBuffer* buffer) {
    return scene.tables().identifies_rays() ? intersect_identified(scene, some, lanes, {camera.pixel, camera.sample, 0},
                                                                   Coherence::coherent, &camera)
                                            : scene.accelerator().intersect(some, lanes, Coherence::coherent, buffer);
  };
  const FloatN near = rays.near;
  Hits hits = intersect(rays, active, scene.camera_buffer());
  if (!scene.tables().camera_is_far()) [[likely]]
    return hits;
  const MaskN near_eye = hits.hit & (rays.far < camera.skipped * FloatN(-0.5F));
  if (none(near_eye)) return hits;
  Ray<FloatN> from_eye{rays.origin - rays.direction * camera.skipped, rays.direction, near + camera.skipped,
                       infinity<FloatN>()};
  const Hits near_hits = intersect(from_eye, near_eye, nullptr);
  rays.origin = select(near_eye, from_eye.origin, rays.origin);
  rays.near = select(near_eye, from_eye.near, rays.near);
  rays.far = select(near_eye, from_eye.far, rays.far);
  camera.skipped = select(near_eye, FloatN(0), camera.skipped);
  hits = select(near_eye, near_hits, hits);
  return hits;
}

/// The same. Where shadow catchers act, a ray that meets one first has hit nothing.
RAYTRACE_INLINE Hits intersect_camera_rays(const TracedScene& scene, CameraRays& camera, const MaskN& active) {
  Hits hits = nearest_camera_hits(scene, camera, active);
  if (camera.caught != nullptr) [[unlikely]]
    hits = catch_shadows(scene, camera, hits);
  return hits;
}

}  // namespace raytrace
