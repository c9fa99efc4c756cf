// Direct light by ray casting.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "raytrace/accel/surface_uv.h"
#include "raytrace/accel/traced_scene.h"
#include "raytrace/integrators/raycast.h"
#include "raytrace/math/kernel.h"
#include "raytrace/tracing/camera_hits.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/light_parts.h"
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
  /// The same by light groups: sets `groups`, one for each, where something was hit. The result: the lanes where it
  /// was.
  static MaskN radiance_by_group(const TracedScene& scene, CameraRays& camera, const MaskN& active,
                                 const MaskN& counted, RayCounts& counts, FirstHits* first,
                                 std::span<Rgb<FloatN>> groups);

  /// The passes of what radiance() says, or radiance_by_group(), of those camera rays; first: as it set that.
  static PassLight passes(const TracedScene& scene, const CameraRays& camera, const FirstHits& first,
                          const RayResult& result, const MaskN& counted);

 private:
  /// Light comes to fibres from all sides; other surfaces know only that from their own.
  class AroundFibres {
   public:
    AroundFibres(const SceneTables& tables, const Hits& hits)
        : fibres_(tables.is_fibre(hits)), lights_{fibres_, fibres_, boundary_, distance_}, has_any_(any(fibres_)) {}
    AroundFibres(const AroundFibres&) = delete;
    AroundFibres& operator=(const AroundFibres&) = delete;

    const LightsBehind* lights() const { return has_any_ ? &lights_ : nullptr; }

   private:
    MaskN fibres_;
    MediumBoundary boundary_;
    FloatN distance_{0};
    LightsBehind lights_;
    bool has_any_;
  };
  /// shade(hits, surface, textures): the radiance where something was hit.
  template <class Shade>
  static RayResult trace(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                         const MaskN& active, FirstHits* first, const Shade& shade);
};

template <class Shade>
RAYTRACE_INLINE RayResult Kernel<Raycast>::trace(const TracedScene& scene, const Rgb<float>& background,
                                                 CameraRays& camera, const MaskN& active, FirstHits* first,
                                                 const Shade& shade) {
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
  return {select(hits.hit, shade(hits, surface, textures ? &*textures : nullptr), Rgb<FloatN>(background)), hits.hit};
}

inline RayResult Kernel<Raycast>::radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                                           const MaskN& active, const MaskN& counted, RayCounts& counts,
                                           FirstHits* first) {
  const SceneTables& tables = scene.tables();
  return trace(scene, background, camera, active, first,
               [&](const Hits& hits, const SurfaceInteraction<FloatN>& surface, const TexturePoint<FloatN>* textures)
                   RAYTRACE_INLINE_LAMBDA {
                     // What a ray meets on its way to one light says nothing of that to another, nor of the camera
                     // ray's.
                     const ShadowNumbers numbers{camera.pixel, camera.sample, 1};
                     const AroundFibres around(tables, hits);
                     Rgb<FloatN> radiance = direct_light(scene, tables.light_groups().front(), hits, surface, textures,
                                                         Coherence::coherent, counted, counts, numbers, nullptr,
                                                         nullptr, nullptr, false, around.lights());
                     if (tables.has_emission()) [[unlikely]]
                       radiance += tables.emitted(hits, surface, textures);
                     return radiance;
                   });
}

[[gnu::noinline]] inline MaskN Kernel<Raycast>::radiance_by_group(const TracedScene& scene, CameraRays& camera,
                                                                  const MaskN& active, const MaskN& counted,
                                                                  RayCounts& counts, FirstHits* first,
                                                                  std::span<Rgb<FloatN>> groups) {
  const SceneTables& tables = scene.tables();
  const Rgb<float> black(0, 0, 0);
  const auto shade = [&](const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                         const TexturePoint<FloatN>* textures) {
    const ShadowNumbers numbers{camera.pixel, camera.sample, 1};
    const AroundFibres around(tables, hits);
    Rgb<FloatN> emitted(black);
    IntN emitter(0);
    if (tables.has_emission()) {
      emitted = tables.emitted(hits, surface, textures);
      emitter = tables.light_group_of_material(tables.material(hits));
    }
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const SceneTables::LightGroup& group = tables.light_groups()[i];
      const MaskN shines = float_mask<FloatN>(emitter == IntN(static_cast<std::int32_t>(i)));
      groups[i] = select(shines, emitted, Rgb<FloatN>(black));
      if (!group.is_dark())
        groups[i] += direct_light(scene, group, hits, surface, textures, Coherence::coherent, counted, counts, numbers,
                                  nullptr, nullptr, nullptr, false, around.lights());
    }
    return Rgb<FloatN>(black);
  };
  return trace(scene, black, camera, active, first, shade).hit;
}

[[gnu::noinline]] inline PassLight Kernel<Raycast>::passes(const TracedScene& scene, const CameraRays& camera,
                                                           const FirstHits& first, const RayResult& result,
                                                           const MaskN& counted) {
  PassLight light = emitted_or_behind({result.radiance, MaskN(false)});
  const auto pass = [&](LightPass which) -> Rgb<FloatN>& { return light[static_cast<std::size_t>(which)]; };
  const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
  pass(LightPass::background) = select(result.hit, black, pass(LightPass::background));
  if (none(first.hits.hit)) return light;
  const SceneTables& tables = scene.tables();
  const TexturePoint<FloatN>* const textures = first.textures ? &*first.textures : nullptr;
  LightParts parts;
  Rgb<FloatN> all = black;
  RayCounts counts;  // of rays that have been counted
  const AroundFibres around(tables, first.hits);
  for (const SceneTables::LightGroup& group : tables.light_groups())
    all += direct_light(scene, group, first.hits, first.surface, textures, Coherence::coherent, counted, counts,
                        {camera.pixel, camera.sample, 1}, nullptr, nullptr, nullptr, false, around.lights(), &parts);
  pass(LightPass::diffuse_direct) = select(first.hits.hit, parts.take_diffuse(all), black);
  pass(LightPass::specular_direct) = select(first.hits.hit, parts.gloss, black);
  pass(LightPass::transmission_direct) = select(first.hits.hit, parts.transmitted, black);
  if (tables.has_emission())
    pass(LightPass::emission) = select(first.hits.hit, tables.emitted(first.hits, first.surface, textures), black);
  return light;
}

}  // namespace raytrace
