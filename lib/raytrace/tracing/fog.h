// Fogs on the ways of rays.
#pragma once

#include "raytrace/accel/traced_scene.h"

namespace raytrace {

/// What a point is in, on the side that light comes from.
struct PointMedia {
  const MediumStack& stack;
  const IntN& current;  ///< that of them which counts
  const Vec3<FloatN>* behind =
      nullptr;  ///< where rays have passed the boundaries in the point's own place; null: there
};

/// How much of a ray's length is at its end: more than what rounding makes of two surfaces in one place.
inline constexpr float end_of_ray = 0x1p-16F;

/// For rays that cross boundaries of fogs, in the lanes that hit them, and go on from `behind`: crosses all others that
/// lie between, as where two fogs end in one plane. seeing: as below.
void cross_others(const TracedScene& scene, const Ray<FloatN>& rays, const Hits& hits, const Vec3<FloatN>& behind,
                  const RayIds& ids, const MaskN& seeing, MediumStack& media);

/// Goes along rays from boundary to boundary of fogs, as far as they reach, or nearly: what ends at a surface, such as
/// the fog of a room at its wall, is passed by what comes through that surface alone. media: where the rays start; then
/// where they end.
///
/// part(lanes, fog, number, begin, end): called once for each interval between two boundaries. `lanes` are in a fog
/// there, each in the one that `fog` says; `number` counts the intervals; begin, end: as distances along rays are. The
/// result: the lanes that go on behind it; the others' media stay what they are there.
/// seeing: the lanes that the camera sees by, for which fogs that are not visible to it are not there.
template <class Part>
void for_each_part_in_fog(const TracedScene& scene, const Ray<FloatN>& rays, MaskN lanes, const RayIds& ids,
                          MediumStack& media, const MaskN& seeing, const Part& part) {
  constexpr int most_boundaries = 1000;  // where rounding keeps a ray at one
  const SceneTables& tables = scene.tables();
  const FloatN reach = rays.far * FloatN(1 - end_of_ray);
  Ray<FloatN> left = rays;
  left.near = FloatN(0);
  FloatN begin(0);
  for (int boundaries = 0; boundaries < most_boundaries && any(lanes); ++boundaries) {
    left.far = reach - begin;
    RayIdentity identity(tables, scene.accelerator(), left, ids);
    identity.meets = Meets::boundaries_of_fogs;
    identity.set_seeing(seeing);
    Hits hits =
        scene.accelerator().intersect(left, lanes & (left.far > FloatN(0)), Coherence::incoherent, nullptr, &identity);
    const FloatN end = select(hits.hit, min(begin + left.far, rays.far), rays.far);
    IntN inside(0);
    MaskN enters(false), leaves(false);
    Vec3<FloatN> behind = left.origin;
    if (any(hits.hit)) {
      if (tables.has_motion()) [[unlikely]]
        hits.time = ids.times();
      const SurfaceInteraction<FloatN> surface = scene.accelerator().surface(left, hits);
      inside = select_lanes(hits.hit, tables.inside(hits), IntN(0));
      enters = hits.hit & surface.front;
      leaves = hits.hit & !surface.front;
      behind = offset_ray_origin(surface, hits.hit);
      // What rays come out of they have been in since they began.
      media.add_first(leaves & !media.contains(inside), inside);
    }
    const IntN fog = media.current(tables.media());
    const MaskN in_fog = lanes & tables.media().is_fog(fog);
    if (any(in_fog)) lanes = (lanes & !in_fog) | part(in_fog, fog, boundaries, begin, end);
    lanes = lanes & hits.hit;
    if (none(lanes)) return;
    media.add(lanes & enters, inside);
    media.remove(lanes & leaves, inside);
    if (scene.accelerator().has_several_fogs()) {
      hits.hit = lanes;
      cross_others(scene, left, hits, behind, ids, seeing, media);
    }
    left.origin = select(lanes, behind, left.origin);
    begin = end;
  }
}

/// For rays that came through the surfaces where they start, in those lanes: passes the boundaries of fogs in the same
/// places, which the rays that ended there did not pass, such as of a fog that ends at a window; rays start behind
/// them. distance: at least that of the rays that ended there. media: where these ended; then where the rays start.
void pass_boundaries_at_starts(const TracedScene& scene, Ray<FloatN>& rays, MaskN lanes, const FloatN& distance,
                               const RayIds& ids, MediumStack& media);

/// Of a point on a surface, for light that comes through it in some lanes.
struct MediaOfLight {
  MediumStack stack;
  IntN current;
  Vec3<FloatN> starts;  ///< of the shadow rays, behind boundaries of fogs in the point's place

  PointMedia media() const { return {stack, current, &starts}; }

  /// here: what paths of that length came through to that boundary. shadow_rays: from the point.
  MediaOfLight(const TracedScene& scene, const MediumBoundary& boundary, const MediumStack& here, const MaskN& through,
               const MaskN& front, const Ray<FloatN>& shadow_rays, const FloatN& distance, const RayIds& ids)
      : stack(here), current(boundary.current), starts(shadow_rays.origin) {
    const MediumTable& table = scene.tables().media();
    if (table.empty() || none(through)) return;
    boundary.cross(stack, through, front);
    if (table.has_fog()) [[unlikely]] {
      Ray<FloatN> rays = shadow_rays;
      rays.direction = normalize(rays.direction);
      pass_boundaries_at_starts(scene, rays, through, distance, ids, stack);
      starts = rays.origin;
    }
    current = select_lanes(through, stack.current(table), current);
  }
};

/// The share that fogs leave of the light on the way along those rays; media and seeing: as above.
Rgb<FloatN> fog_transmittance(const TracedScene& scene, const Ray<FloatN>& rays, const MaskN& lanes, const RayIds& ids,
                              MediumStack& media, const MaskN& seeing = MaskN(false));

/// What is left of the light that comes along shadow rays to points in media. seeing: as above.
inline Rgb<FloatN> light_through(const TracedScene& scene, const Ray<FloatN>& rays, const MaskN& lanes,
                                 const RayIds& ids, const PointMedia& media, const MaskN& seeing = MaskN(false)) {
  const MediumTable& table = scene.tables().media();
  if (!table.has_fog()) [[likely]]
    return table.transmittance(media.current, length(rays.direction) * rays.far);
  MediumStack stack = media.stack;
  Ray<FloatN> left = rays;
  if (media.behind != nullptr) left.origin = *media.behind;
  const Rgb<FloatN> fogs = fog_transmittance(scene, left, lanes, ids, stack, seeing);
  const Rgb<FloatN> clear = table.transmittance(media.current, length(rays.direction) * rays.far);
  return select(table.is_fog(media.current), fogs, fogs * clear);
}

}  // namespace raytrace
