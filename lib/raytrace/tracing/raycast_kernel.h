// Direct light by ray casting.
#pragma once

#include <optional>

#include "raytrace/accel/surface_uv.h"
#include "raytrace/accel/traced_scene.h"
#include "raytrace/integrators/raycast.h"
#include "raytrace/math/kernel.h"
#include "raytrace/tracing/camera_hits.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/ray_result.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

template <>
class Kernel<Raycast> {
 public:
  static constexpr bool takes_samples = false;
  static RadianceRange radiance_range(const SceneTables& scene) { return scene.radiance_range(); }

  static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                            const MaskN& active, const MaskN& counted, RayCounts& counts, FirstHits* first);
};

inline RayResult Kernel<Raycast>::radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                                           const MaskN& active, const MaskN& counted, RayCounts& counts,
                                           FirstHits* first) {
  const SceneTables& tables = scene.tables();
  const Hits hits = intersect_camera_rays(scene, camera, active);
  if (first != nullptr) {
    first->hits = hits;
    first->textures.reset();
  }
  if (none(hits.hit)) return {Rgb<FloatN>(background), hits.hit};

  SurfaceInteraction<FloatN> surface = scene.accelerator().surface(camera.rays, hits);
  const std::optional<TexturePoint<FloatN>> textures =
      add_textures(tables, hits, surface, [&]() RAYTRACE_INLINE_LAMBDA { return camera_radius(tables, camera); });
  if (first != nullptr) {
    first->surface = surface;
    first->textures = textures;
  }
  // What a ray meets on its way to one light says nothing of that to another, nor of the camera ray's.
  const ShadowNumbers numbers{camera.pixel, camera.sample, 1};
  Rgb<FloatN> radiance = direct_light(scene, hits, surface, textures ? &*textures : nullptr, Coherence::coherent,
                                      counted, counts, numbers);
  if (tables.has_emission()) [[unlikely]]
    radiance += tables.emitted(hits, surface, textures ? &*textures : nullptr);
  return {select(hits.hit, radiance, Rgb<FloatN>(background)), hits.hit};
}

}  // namespace raytrace
