// The accelerator's queries in scenes that may identify their rays (accel/cutouts.h). ids: which rays these are.
#pragma once

#include "raytrace/accel/traced_scene.h"

namespace raytrace {

/// In scenes that identify their rays. to_camera: whether what is not visible to the camera hides nothing.
[[gnu::noinline]] inline MaskN occluded_identified(const TracedScene& scene, const Ray<FloatN>& rays,
                                                   const MaskN& active, const RayIds& ids, Coherence coherence,
                                                   bool to_camera = false) {
  RayIdentity identity(scene.tables(), scene.accelerator(), rays, ids);
  if (to_camera) identity.set_seeing(MaskN(true));
  return scene.accelerator().occluded(rays, active, coherence, nullptr, &identity);
}

RAYTRACE_INLINE MaskN occluded(const TracedScene& scene, const Ray<FloatN>& rays, const MaskN& active,
                               const RayIds& ids, Coherence coherence, bool to_camera = false) {
  return scene.tables().identifies_rays() ? occluded_identified(scene, rays, active, ids, coherence, to_camera)
                                          : scene.accelerator().occluded(rays, active, coherence);
}

/// In scenes that identify their rays. camera: as RayIdentity's. seeing: those that the camera sees by, of other rays.
[[gnu::noinline]] inline Hits intersect_identified(const TracedScene& scene, Ray<FloatN>& rays, const MaskN& active,
                                                   const RayIds& ids, Coherence coherence,
                                                   const CameraRays* camera = nullptr,
                                                   const MaskN& seeing = MaskN(false)) {
  RayIdentity identity(scene.tables(), scene.accelerator(), rays, ids, camera);
  if (camera == nullptr) identity.set_seeing(seeing);
  return scene.accelerator().intersect(rays, active, coherence, nullptr, &identity);
}

RAYTRACE_INLINE Hits intersect(const TracedScene& scene, Ray<FloatN>& rays, const MaskN& active, const RayIds& ids,
                               Coherence coherence, const MaskN& seeing = MaskN(false)) {
  return scene.tables().identifies_rays() ? intersect_identified(scene, rays, active, ids, coherence, nullptr, seeing)
                                          : scene.accelerator().intersect(rays, active, coherence);
}

}  // namespace raytrace
