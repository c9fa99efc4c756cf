// Direct light by ray casting.
#pragma once

#include <array>
#include <bit>

#include "raytrace/accel/surface_uv.h"
#include "raytrace/accel/traced_scene.h"
#include "raytrace/integrators/raycast.h"
#include "raytrace/math/kernel.h"
#include "raytrace/tracing/camera_hits.h"
#include "raytrace/tracing/ray_result.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

template <>
class Kernel<Raycast> {
 public:
  static RadianceRange radiance_range(const SceneTables& scene) { return scene.radiance_range(); }

  static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                            const MaskN& active, const MaskN& counted, RayCounts& counts, FirstHits* first);

 private:
  [[gnu::noinline]] static MaskN occluded_with_cutouts(const TracedScene& scene, const Ray<FloatN>& rays,
                                                       const MaskN& active, const UintN& key, std::size_t light) {
    // What a ray meets on its way to one light says nothing of that to another, nor of the camera ray's.
    const UintN keys = key + UintN(0x9e3779b9U * static_cast<std::uint32_t>(light + 1));
    const CutoutQuery query{scene.tables(), scene.accelerator(), rays, keys};
    return scene.accelerator().occluded(rays, active, Coherence::coherent, nullptr, &query);
  }

  /// Lights are gathered in runs of this many before the materials get them, so that each material reads its parameters
  /// once a run. Runs are counted with the lights that reach no lane: how a lane's radiance is summed must not depend
  /// on the others.
  static constexpr std::size_t lights_per_run = 16;
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
  std::optional<TexturePoint<FloatN>> textures;
  if (tables.has_textures(hits)) [[unlikely]] {
    textures = texture_point(tables, camera, hits, surface);
    if (tables.has_relief()) tables.add_relief(hits, *textures, surface);
  }
  if (first != nullptr) {
    first->surface = surface;
    first->textures = textures;
  }

  std::array<IncidentLight, lights_per_run> incident;
  std::size_t count = 0;
  Rgb<FloatN> radiance{Rgb<float>(0, 0, 0)};
  Rgb<float> ambient = tables.ambient_radiance();
  const auto shade_run = [&] {
    radiance += tables.shade(hits, surface, ambient, {incident.data(), count}, textures ? &*textures : nullptr);
    ambient = Rgb<float>(0, 0, 0);
    count = 0;
  };
  Ray<FloatN> shadow_rays;
  shadow_rays.origin = offset_ray_origin(surface);
  shadow_rays.near = FloatN(0);
  for (std::size_t number = 0; number < tables.lights().size(); ++number) {
    // The first run has the ambient light, whatever the others reach.
    if (number > 0 && number % lights_per_run == 0 && (count > 0 || number == lights_per_run)) shade_run();
    const LightSource& light = *tables.lights()[number];
    const bool shadows = light.shadows();
    IncidentLight& here = incident[count];  // written in its array at once: it is large
    light.sample(shadow_rays, here.radiance);
    // Of any length: the shadow rays need not wait for a square root and a quotient.
    MaskN lit = hits.hit & (dot(surface.ns, shadow_rays.direction) > FloatN(0));
    if (shadows && any(lit)) {
      counts.shadow += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(lit & counted)));
      const MaskN occluded = tables.has_cutouts() ? occluded_with_cutouts(scene, shadow_rays, lit, camera.key, number)
                                                  : scene.accelerator().occluded(shadow_rays, lit, Coherence::coherent,
                                                                                 scene.light_buffer(number));
      lit = lit & !occluded;
    }
    if (none(lit)) continue;
    here.wi = normalize(shadow_rays.direction);
    here.cosine = select(lit, max(dot(surface.ns, here.wi), FloatN(0)), FloatN(0));
    if (surface.has_relief) [[unlikely]]
      here.cosine = here.cosine * relief_shadow(surface, here.wi);
    ++count;
  }
  if (count > 0 || tables.lights().size() <= lights_per_run) shade_run();
  return {select(hits.hit, radiance, Rgb<FloatN>(background)), hits.hit};
}

}  // namespace raytrace
