// Light that is drawn from one of the scene's shining surfaces or from the environment: next-event estimation with
// multiple importance sampling (Veach 1997, chapter 9; pbrt-v4, section 13.4).
#pragma once

#include "raytrace/math/frame.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/fog.h"
#include "raytrace/tracing/identified_rays.h"
#include "raytrace/tracing/stage_times.h"

namespace raytrace {

/// The share that a direction's estimate counts that was drawn at density `own`, and might have been at `other`: the
/// power heuristic. own: infinite where nothing else draws it.
inline FloatN power_heuristic(const FloatN& own, const FloatN& other) {
  const FloatN ratio = other / own;
  return select(own < infinity<FloatN>(), FloatN(1) / (FloatN(1) + ratio * ratio), FloatN(1));
}

/// By magnitude.
inline FloatN largest(const Rgb<FloatN>& color) { return max(max(abs(color.red), abs(color.green)), abs(color.blue)); }

/// A point of a path.
struct PathVertex {
  const Hits& hits;
  const SurfaceInteraction<FloatN>& surface;
  const TexturePoint<FloatN>* textures;
  Frame<FloatN> frame;  ///< about surface.ns
  FloatN distance;      ///< that the path came to it
  MaskN both_sides;     ///< light is drawn for it from behind as well
  MaskN fibres;         ///< likewise; whatever the normal for shading says, ng says which side it is

  /// The normal by which it is drawn.
  Vec3<FloatN> side() const {
    return any(both_sides) ? select(both_sides, Vec3<FloatN>(Vec3f(0, 0, 0)), surface.ns) : surface.ns;
  }
};

/// How often light is drawn from the environment, and not from a shining surface.
inline float environment_share_of(const SceneTables& tables) {
  if (tables.environment() == nullptr) return 0;
  return tables.emitters().empty() ? 1 : 0.5F;
}

/// Light that was drawn for a vertex.
struct DrawnLight {
  MaskN lit{false};                    ///< where there is any that may arrive
  Ray<FloatN> ray;                     ///< from the vertex to the light
  Vec3<FloatN> wi, local_wi;           ///< its direction, of unit length; and in the vertex's frame
  FloatN pdf;                          ///< per solid angle
  MaskN through{false};                ///< where it arrives from behind the surface
  MaskN is_sky;                        ///< whether it is the environment's; else it is of a surface
  EmitterTable::Sample sample;         ///< of a surface
  SurfaceInteraction<FloatN> surface;  ///< where it leaves from
  Rgb<FloatN> radiance;                ///< the environment's
};

inline void draw_from_surfaces(const SceneTables& tables, const SurfaceInteraction<FloatN>& surface,
                               const Vec3<FloatN>& normal, const FloatN& time, const FloatN& choice,
                               const Sample2D& point, DrawnLight& result) {
  result.sample = tables.emitters().sample(surface.p, normal, time, choice, point.x, point.y);
  const PatchSample& drawn = result.sample.point;
  SurfaceInteraction<FloatN>& light = result.surface;
  light = {};
  light.front = dot(drawn.normal, drawn.way) < FloatN(0);
  light.ng = select(light.front, drawn.normal, -drawn.normal);
  light.ns = light.ng;
  light.p = drawn.p;
  light.error = max(drawn.error, surface.error);
  result.wi = normalize(drawn.way);
  // The shadow ray ends as far before the light as it starts from the surface, but on the same way: the density is that
  // of its direction. It keeps half of its length where it comes in flat.
  result.ray.direction = drawn.way - (result.ray.origin - surface.p);
  const FloatN height = max(-dot(light.ng, result.ray.direction), FloatN(1e-30F));
  result.ray.far = max(FloatN(1) - light.error * FloatN(4) / height, FloatN(0.5F));
  result.pdf = select(drawn.pdf < infinity<FloatN>(), drawn.pdf, FloatN(0));
}

/// Drawn from a surface or the environment, for points on surfaces, or in media, where ns and ng have the length 0.
/// normal: by which it is drawn, of length 0 if all sides count. time: of the rays, as Hits have it. local_wi is not
/// set, and `lit` says of all lanes whether there is light.
inline DrawnLight draw_light(const SceneTables& tables, const SurfaceInteraction<FloatN>& surface,
                             const Vec3<FloatN>& normal, const FloatN& time, const Sample2D& choice,
                             const Sample2D& point) {
  const float environment_share = environment_share_of(tables);
  DrawnLight light;
  light.is_sky = choice.y < FloatN(environment_share);
  light.ray.origin = offset_ray_origin(surface);
  light.ray.near = FloatN(0);
  if (environment_share < 1) {
    draw_from_surfaces(tables, surface, normal, time, choice.x, point, light);
    light.pdf = light.pdf * FloatN(1 - environment_share);
  }
  if (environment_share > 0) {
    const EnvironmentSample sky = tables.environment()->sample(point.x, point.y);
    const FloatN pdf = sky.pdf * FloatN(environment_share);
    light.radiance = sky.radiance;
    light.ray.direction = environment_share < 1 ? select(light.is_sky, sky.wi, light.ray.direction) : sky.wi;
    light.ray.far =
        environment_share < 1 ? select(light.is_sky, infinity<FloatN>(), light.ray.far) : infinity<FloatN>();
    light.wi = environment_share < 1 ? select(light.is_sky, normalize(sky.wi), light.wi) : normalize(sky.wi);
    light.pdf = environment_share < 1 ? select(light.is_sky, pdf, light.pdf) : pdf;
  }
  light.surface.wo = -light.wi;
  light.lit = light.pdf > FloatN(0);
  return light;
}

/// For a vertex.
inline DrawnLight draw_light(const SceneTables& tables, const PathVertex& vertex, const Sample2D& choice,
                             const Sample2D& point) {
  const SurfaceInteraction<FloatN>& surface = vertex.surface;
  DrawnLight light = draw_light(tables, surface, vertex.side(), vertex.hits.time, choice, point);
  light.local_wi = vertex.frame.to_local(light.wi);
  MaskN faces = (light.local_wi.z > FloatN(0)) & (dot(light.wi, surface.true_normal()) > FloatN(0));
  if (any(vertex.both_sides)) {
    const MaskN behind = dot(light.wi, surface.ng) < FloatN(0);
    light.through = vertex.both_sides & behind & (vertex.fibres | (light.local_wi.z < FloatN(0)));
    const Vec3<FloatN> origin = offset_ray_origin(surface, light.through);
    light.ray.direction =
        select(light.through & !light.is_sky, light.ray.direction + (light.ray.origin - origin), light.ray.direction);
    light.ray.origin = origin;
    faces = faces | light.through | vertex.fibres;
  }
  light.lit = vertex.hits.hit & light.lit & faces;
  return light;
}

/// The radiance that it sends, in the lanes of `lit`. distance: that paths came to where it arrives.
inline Rgb<FloatN> radiance_of(const SceneTables& tables, const DrawnLight& light, const FloatN& distance) {
  const float environment_share = environment_share_of(tables);
  Rgb<FloatN> radiance(Rgb<float>(0, 0, 0));
  if (environment_share < 1)
    radiance = tables.emitted(light.sample, light.lit & !light.is_sky, light.surface, [&](const Hits& hits) {
      const FloatN width = tables.ray_cone().half_width(distance + length(light.ray.direction));
      return texture_point(tables, width, hits, light.surface);
    });
  if (environment_share > 0) radiance = select(light.is_sky, light.radiance, radiance);
  return radiance;
}

/// What of it leaves the vertex along wo: over the density of the draw, times its share beside directions that the BSDF
/// draws. bsdf: for wo and the light's direction. media: where the light arrives; null if the scene
/// has none. panes: likewise.
inline Rgb<FloatN> arriving_light(const TracedScene& scene, const PathVertex& vertex, const DrawnLight& light,
                                  const BsdfValue& bsdf, Coherence coherence, const RayIds& ids, RayCounts& counts,
                                  StageClock& clock, const PointMedia* media, const PanesAhead* panes) {
  const SceneTables& tables = scene.tables();
  FloatN weight = abs(light.local_wi.z) / light.pdf * power_heuristic(light.pdf, bsdf.pdf);
  if (vertex.surface.has_relief)
    weight = select(light.through, weight, weight * relief_shadow(vertex.surface, light.wi));
  const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
  Rgb<FloatN> radiance = bsdf.f * radiance_of(tables, light, vertex.distance) * weight;
  const MaskN lit = light.lit & (largest(radiance) > FloatN(0));
  if (none(lit)) return black;
  counts.shadow += count_lanes(lit);
  clock.end(Stage::lights);
  const MaskN hidden = panes != nullptr ? occluded_behind_panes(scene, light.ray, lit, ids, coherence, *panes, radiance)
                                        : occluded(scene, light.ray, lit, ids, coherence);
  const MaskN arrives = lit & !hidden;
  clock.end(Stage::trace);
  if (media == nullptr) [[likely]]
    return select(arrives, radiance, black);
  return select(arrives, radiance * light_through(scene, light.ray, arrives, ids, *media), black);
}

}  // namespace raytrace
