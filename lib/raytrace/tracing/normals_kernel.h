// Shading normals as colours.
#pragma once

#include "raytrace/accel/surface_uv.h"
#include "raytrace/accel/traced_scene.h"
#include "raytrace/integrators/normals.h"
#include "raytrace/math/kernel.h"
#include "raytrace/tracing/camera_hits.h"
#include "raytrace/tracing/ray_result.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

template <>
class Kernel<Normals> {
 public:
  static constexpr bool takes_samples = false;
  static RadianceRange radiance_range(const SceneTables& scene) {
    RadianceRange range = scene.background_range();
    range.usual = 1;
    return range;
  }

  static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                            const MaskN& active, const MaskN&, RayCounts&, FirstHits* first) {
    const Hits hits = intersect_camera_rays(scene, camera, active);
    if (first != nullptr) {
      first->hits = hits;
      first->textures.reset();
    }
    if (none(hits.hit)) return {Rgb<FloatN>(background), hits.hit};
    SurfaceInteraction<FloatN> surface = scene.accelerator().surface(camera.rays, hits);
    if (const SceneTables& tables = scene.tables(); tables.has_textures(hits)) {
      const TexturePoint<FloatN> textures = texture_point(tables, camera, hits, surface);
      if (tables.has_relief()) tables.add_relief(hits, textures, surface);
      if (first != nullptr) first->textures = textures;
    }
    if (first != nullptr) first->surface = surface;
    const auto color = [](const FloatN& component) {
      return min(max(component * FloatN(0.5F) + FloatN(0.5F), FloatN(0)), FloatN(1));
    };
    const Rgb<FloatN> normal{color(surface.ns.x), color(surface.ns.y), color(surface.ns.z)};
    return {select(hits.hit, normal, Rgb<FloatN>(background)), hits.hit};
  }
};

}  // namespace raytrace
