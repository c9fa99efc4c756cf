#include "raytrace/tracing/fog.h"

#include <array>
#include <span>

#include "raytrace/sampling/hash.h"
#include "raytrace/tracing/density_walk.h"

namespace raytrace {

void pass_boundaries_at_starts(const TracedScene& scene, Ray<FloatN>& rays, MaskN lanes, const FloatN& distance,
                               const RayIds& ids, MediumStack& media) {
  constexpr int most_boundaries = 16;
  const SceneTables& tables = scene.tables();
  const Vec3<FloatN> start = rays.origin;
  const FloatN size = distance + abs(start.x) + abs(start.y) + abs(start.z), before = size * FloatN(end_of_ray);
  Ray<FloatN> left{start - rays.direction * before, rays.direction, FloatN(0), FloatN(0)};
  FloatN reach = before * FloatN(1 + 1.0F / 16);
  for (int boundaries = 0; boundaries < most_boundaries && any(lanes); ++boundaries) {
    left.far = reach;
    RayIdentity identity(tables, scene.accelerator(), left, ids);
    identity.meets = Meets::boundaries_of_fogs;
    Hits hits =
        scene.accelerator().intersect(left, lanes & (reach > FloatN(0)), Coherence::incoherent, nullptr, &identity);
    lanes = hits.hit;
    if (none(lanes)) return;
    if (tables.has_motion()) [[unlikely]]
      hits.time = ids.times();
    const SurfaceInteraction<FloatN> surface = scene.accelerator().surface(left, hits);
    const IntN inside = select_lanes(lanes, tables.inside(hits), IntN(0));
    // Some may have been passed before: the last one says what the rays are in.
    const MaskN is_in = media.contains(inside);
    media.add(lanes & surface.front & !is_in, inside);
    media.remove(lanes & !surface.front & is_in, inside);
    left.origin = select(lanes, offset_ray_origin(surface, lanes), left.origin);
    reach = reach - left.far;
    const MaskN ahead = lanes & (dot(left.origin - start, rays.direction) > FloatN(0));
    rays.origin = select(ahead, left.origin, rays.origin);
  }
}

void cross_others(const TracedScene& scene, const Ray<FloatN>& rays, const Hits& hits, const Vec3<FloatN>& behind,
                  const RayIds& ids, const MaskN& seeing, MediumStack& media) {
  const SceneTables& tables = scene.tables();
  std::array<Hits, 4> crossed;  // as many fogs as paths know that they are in
  crossed.front() = hits;
  const Vec3<FloatN>& direction = rays.direction;
  const FloatN end = dot(behind - rays.origin, direction) / dot(direction, direction);
  MaskN lanes = hits.hit;
  Ray<FloatN> left = rays;
  // What lies where the ray has hit the first of them counts.
  left.near = max(same_bits<FloatN>(same_bits<UintN>(max(rays.far, FloatN(1e-37F))) - UintN(1u)), FloatN(0));
  for (std::size_t count = 1; count < crossed.size(); ++count) {
    left.far = end;
    RayIdentity identity(tables, scene.accelerator(), left, ids);
    identity.meets = Meets::boundaries_of_fogs;
    identity.crossed = std::span<const Hits>(crossed).first(count);
    identity.set_seeing(seeing);
    lanes = lanes & (left.near < end);
    if (none(lanes)) return;
    Hits& other = crossed[count];
    other = scene.accelerator().intersect(left, lanes, Coherence::incoherent, nullptr, &identity);
    lanes = other.hit;
    if (none(lanes)) return;
    if (tables.has_motion()) [[unlikely]]
      other.time = ids.times();
    const MaskN front = scene.accelerator().surface(left, other).front;
    const IntN inside = select_lanes(lanes, tables.inside(other), IntN(0));
    media.add(lanes & front, inside);
    media.remove(lanes & !front, inside);
  }
}

namespace {

/// A part of rays' ways.
struct RayPart {
  const FloatN& begin;
  const FloatN& end;
};

/// In lanes whose fog is not the same everywhere, what that leaves on this part of the way; in the others `even`.
[[gnu::noinline]] Rgb<FloatN> density_transmittance(const SceneTables& tables, const Ray<FloatN>& rays,
                                                    const FloatN& unit, const MaskN& in_fog, const IntN& fog,
                                                    const RayPart& part, const UintN& key, Rgb<FloatN> even) {
  for_each_value(tables.media().density(fog), in_fog & tables.media().has_density(fog),
                 [&](std::int32_t number, const MaskN& here) {
                   const FloatN left = left_by(tables.densities()[number], rays, unit, here, part.begin, part.end,
                                               mix_bits(key ^ UintN(0x7261746fU)));
                   even = select(here, Rgb<FloatN>(left, left, left), even);
                 });
  return even;
}

}  // namespace

Rgb<FloatN> fog_transmittance(const TracedScene& scene, const Ray<FloatN>& rays, const MaskN& lanes, const RayIds& ids,
                              MediumStack& media, const MaskN& seeing) {
  const FloatN unit = length(rays.direction);
  Rgb<FloatN> left(Rgb<float>(1, 1, 1));
  for_each_part_in_fog(scene, rays, lanes, ids, media, seeing,
                       [&](const MaskN& in_fog, const IntN& fog, int part, const FloatN& begin, const FloatN& end) {
                         Rgb<FloatN> here = scene.tables().media().transmittance(fog, (end - begin) * unit);
                         if (scene.tables().media().has_densities()) [[unlikely]]
                           here = density_transmittance(scene.tables(), rays, unit, in_fog, fog, {begin, end},
                                                        ids.keys() + UintN(static_cast<std::uint32_t>(part)), here);
                         left = select(in_fog, left * here, left);
                         return in_fog;
                       });
  return left;
}

}  // namespace raytrace
