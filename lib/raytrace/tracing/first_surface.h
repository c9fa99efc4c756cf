// What integrators share that show what camera rays meet first.
#pragma once

#include "raytrace/tracing/camera_hits.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/ray_result.h"

namespace raytrace {

/// color(what was met) where the rays meet something, else the background; an integrator's radiance().
template <class Color>
RayResult of_first_surface(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                           const MaskN& active, FirstHits* first, const Color& color) {
  FirstHits own;
  FirstHits& met = first != nullptr ? *first : own;
  met.hits = intersect_camera_rays(scene, camera, active);
  met.textures.reset();
  const MaskN& hit = met.hits.hit;
  if (none(hit)) return {Rgb<FloatN>(background), hit};
  met.surface = scene.accelerator().surface(camera.rays, met.hits);
  met.textures =
      add_textures(scene.tables(), met.hits, met.surface, [&] { return camera_radius(scene.tables(), camera); });
  return {select(hit, color(met), Rgb<FloatN>(background)), hit};
}

/// Of colours from 0 to 1.
inline RadianceRange range_of_colors(const SceneTables& scene) {
  RadianceRange range = scene.background_range();
  range.usual = 1;
  return range;
}

}  // namespace raytrace
