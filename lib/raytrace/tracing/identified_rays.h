// The accelerator's queries in scenes that may identify their rays (accel/cutouts.h). ids: which rays these are.
#pragma once

#include "raytrace/accel/traced_scene.h"

namespace raytrace {

/// In scenes that identify their rays.
[[gnu::noinline]] inline MaskN occluded_identified(const TracedScene& scene, const Ray<FloatN>& rays,
                                                   const MaskN& active, const RayIds& ids, Coherence coherence) {
  const RayIdentity identity(scene.tables(), scene.accelerator(), rays, ids);
  return scene.accelerator().occluded(rays, active, coherence, nullptr, &identity);
}

RAYTRACE_INLINE MaskN occluded(const TracedScene& scene, const Ray<FloatN>& rays, const MaskN& active,
                               const RayIds& ids, Coherence coherence) {
  return scene.tables().identifies_rays() ? occluded_identified(scene, rays, active, ids, coherence)
                                          : scene.accelerator().occluded(rays, active, coherence);
}

/// In scenes that identify their rays. camera: as RayIdentity's.
[[gnu::noinline]] inline Hits intersect_identified(const TracedScene& scene, Ray<FloatN>& rays, const MaskN& active,
                                                   const RayIds& ids, Coherence coherence,
                                                   const CameraRays* camera = nullptr) {
  const RayIdentity identity(scene.tables(), scene.accelerator(), rays, ids, camera);
  return scene.accelerator().intersect(rays, active, coherence, nullptr, &identity);
}

RAYTRACE_INLINE Hits intersect(const TracedScene& scene, Ray<FloatN>& rays, const MaskN& active, const RayIds& ids,
                               Coherence coherence) {
  return scene.tables().identifies_rays() ? intersect_identified(scene, rays, active, ids, coherence)
                                          : scene.accelerator().intersect(rays, active, coherence);
}

}  // namespace raytrace
