// Light that is drawn from one of the scene's shining surfaces: next-event estimation with multiple importance sampling
// (Veach 1997, chapter 9; pbrt-v4, section 13.4).
#pragma once

#include <bit>

#include "raytrace/math/frame.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/direct_light.h"

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
  Vec3<FloatN> wo;      ///< in it
  FloatN distance;      ///< that the path came to it
};

/// What leaves the vertex along wo of the light of one surface, chosen and drawn: over the density of the draw, times
/// its share beside directions that the BSDF draws.
inline Rgb<FloatN> sampled_light(const TracedScene& scene, const PathVertex& vertex, const FloatN& choice,
                                 const Sample2D& point, Coherence coherence, const UintN& keys, const MaskN& counted,
                                 RayCounts& counts) {
  const SceneTables& tables = scene.tables();
  const SurfaceInteraction<FloatN>& surface = vertex.surface;
  const EmitterTable::Sample sample = tables.emitters().sample(surface.p, surface.ns, choice, point.x, point.y);

  // A shadow ray ends as far before the light as it starts from the surface.
  SurfaceInteraction<FloatN> light{};
  light.front = dot(sample.point.normal, surface.p - sample.point.p) > FloatN(0);
  light.ng = select(light.front, sample.point.normal, -sample.point.normal);
  light.ns = light.ng;
  light.p = sample.point.p;
  light.error = max(sample.point.error, surface.error);
  Ray<FloatN> ray;
  ray.origin = offset_ray_origin(surface);
  ray.direction = offset_ray_origin(light) - ray.origin;
  ray.near = FloatN(0);
  ray.far = FloatN(1);
  const Vec3<FloatN> wi = normalize(ray.direction), local_wi = vertex.frame.to_local(wi);
  light.wo = -wi;

  const FloatN& pdf = sample.point.pdf;
  MaskN lit = vertex.hits.hit & (pdf > FloatN(0)) & (pdf < infinity<FloatN>()) & (local_wi.z > FloatN(0)) &
              (dot(wi, surface.ng) > FloatN(0));
  const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
  if (none(lit)) return black;
  const BsdfValue bsdf = tables.evaluate(vertex.hits, surface.front, vertex.wo, local_wi, vertex.textures);
  FloatN weight = local_wi.z / pdf * power_heuristic(pdf, bsdf.pdf);
  if (surface.has_relief) weight = weight * relief_shadow(surface, wi);
  const Rgb<FloatN> emitted = tables.emitted(sample, lit, light, [&](const Hits& hits) {
    const FloatN distance = vertex.distance + length(ray.direction);
    return texture_point(tables, tables.ray_cone().half_width(distance), hits, light);
  });
  const Rgb<FloatN> radiance = bsdf.f * emitted * weight;
  lit = lit & (largest(radiance) > FloatN(0));
  if (none(lit)) return black;
  counts.shadow += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(lit & counted)));
  const MaskN occluded = tables.has_cutouts() ? occluded_with_cutouts(scene, ray, lit, keys, coherence)
                                              : scene.accelerator().occluded(ray, lit, coherence);
  return select(lit & !occluded, radiance, black);
}

}  // namespace raytrace
