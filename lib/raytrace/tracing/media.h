// Paths through clear media.
#pragma once

#include "raytrace/accel/surface_uv.h"
#include "raytrace/accel/traced_scene.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/sampling/wavelength.h"
#include "raytrace/scene/medium_table.h"

namespace raytrace {

/// The boundary of media that paths are at which hit something, or, where it lies inside of a medium that counts more,
/// the next one along the ray that does not: rays, hits and surface are set anew there; lanes that meet nothing more
/// are none of hits.hit any longer. Fogs have no such boundaries; what they leave counts already (tracing/fog.h).
///
/// went(lanes, share): called for each part of the way, before rays.far is set anew; what media have left of the light
/// on it. radius(): as texture_point()'s, for media with textures. intersect(rays, lanes): the next hits of rays that
/// go on; it ends them there, and may have them start elsewhere. walked: paths go through what scatters light by
/// random_walk.h, which has counted what is left.
template <class Went, class Radius, class Intersect>
MediumBoundary next_boundary(const TracedScene& scene, MediumStack& stack, Ray<FloatN>& rays, Hits& hits,
                             SurfaceInteraction<FloatN>& surface, const Went& went, const Radius& radius,
                             const Intersect& intersect, bool walked) {
  const SceneTables& tables = scene.tables();
  const MediumTable& media = tables.media();
  for (MaskN arrives = hits.hit;;) {
    const IntN inside = tables.inside(hits);
    if (none(hits.hit & (stack.is_in_any() | float_mask<FloatN>(inside != IntN(0))))) {
      went(arrives, Rgb<FloatN>(Rgb<float>(1, 1, 1)));
      return {};
    }
    const MediumBoundary boundary(media, stack, hits.hit, inside, surface.front);
    Rgb<FloatN> left = media.transmittance(boundary.current, rays.far);
    if (media.has_fog()) [[unlikely]]
      left = select(media.is_fog(boundary.current), Rgb<FloatN>(Rgb<float>(1, 1, 1)), left);
    MaskN in_own = arrives & !surface.front & float_mask<FloatN>(boundary.current == inside);
    if (media.scatters()) [[unlikely]] {
      const MaskN scattered = media.scatters(boundary.current);
      if (walked) left = select(scattered, Rgb<FloatN>(Rgb<float>(1, 1, 1)), left);
      in_own = in_own & !scattered;
    }
    if (any(in_own) && tables.has_textures(hits)) {
      const TexturePoint<FloatN> point = texture_point(tables, radius(), hits, surface);
      left = select(in_own, tables.transmittance(hits, rays.far, &point), left);
    }
    went(arrives, left);
    const MaskN passes = hits.hit & !boundary.is_there;
    if (none(passes)) return boundary;
    boundary.cross(stack, passes, surface.front);
    Ray<FloatN> onward{select(passes, offset_ray_origin(surface, passes), rays.origin), rays.direction, FloatN(0),
                       infinity<FloatN>()};
    const Hits next = intersect(onward, passes);
    rays.origin = onward.origin;
    rays.direction = onward.direction;
    rays.far = select(passes, onward.far, rays.far);
    hits = select(passes, next, hits);
    arrives = passes & hits.hit;
    if (none(hits.hit)) return boundary;
    surface = scene.accelerator().surface(rays, hits);
  }
}

/// In scenes with media that disperse light: draws a wavelength for each of these lanes that has none and is at a
/// surface whose indices depend on it, and sets the boundary's indices to those at the paths' wavelengths. deviation: 0
/// for paths without one. The result: what their light is multiplied by.
[[gnu::noinline]] inline Rgb<FloatN> disperse(const MediumTable& media, MediumBoundary& boundary, const MaskN& lanes,
                                              const UintN& pixel, const UintN& sample, Dimension dimension,
                                              FloatN& deviation) {
  Rgb<FloatN> weights(Rgb<float>(1, 1, 1));
  const MaskN begins = boundary.disperses(media, lanes) & (deviation == FloatN(0));
  if (any(begins)) {
    const WavelengthSample drawn = sample_wavelength(get_2d(pixel, sample, dimension).x);
    deviation = select(begins, drawn.deviation, deviation);
    weights = select(begins, drawn.weights, weights);
  }
  boundary.set_deviation(media, deviation);
  return weights;
}

}  // namespace raytrace
