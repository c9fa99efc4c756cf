#include "raytrace/tracing/random_walk.h"

#include "raytrace/bsdfs/henyey_greenstein.h"
#include "raytrace/sampling/ray_ids.h"
#include "raytrace/tracing/identified_rays.h"

namespace raytrace {

namespace {

constexpr int most_scatterings = 1 << 14;

Rgb<FloatN> exp_of(const Rgb<FloatN>& a) { return {exp(a.red), exp(a.green), exp(a.blue)}; }
FloatN sum(const Rgb<FloatN>& c) { return c.red + c.green + c.blue; }
Rgb<FloatN> magnitudes(const Rgb<FloatN>& c) { return {abs(c.red), abs(c.green), abs(c.blue)}; }
FloatN largest_of(const Rgb<FloatN>& c) { return max(max(c.red, c.green), c.blue); }
Rgb<FloatN> inverse(const Rgb<FloatN>& c) { return {FloatN(1) / c.red, FloatN(1) / c.green, FloatN(1) / c.blue}; }

/// The channel that a number in [0, 1) chooses, each as often as it has light.
FloatN chosen(const FloatN& number, const Rgb<FloatN>& light, const Rgb<FloatN>& values) {
  const FloatN place = number * sum(light);
  return select(place < light.red, values.red, select(place < light.red + light.green, values.green, values.blue));
}

/// What light is scattered by.
struct Scatterers {
  const Rgb<FloatN>& extinction;
  const Rgb<FloatN>& albedo;
  const FloatN& anisotropy;
};

/// The walks of those lanes. met(rays, hits): of lanes that met a surface, which are hits.hit; it moves the origins of
/// those that go on behind it. Its result: those whose walks end. scattered_at(lanes): of those that scatter.
template <class Met, class ScatteredAt>
void walk(const TracedScene& scene, const Scatterers& scatterers, MaskN walks, const WalkIds& ids, Ray<FloatN>& rays,
          Rgb<FloatN>& throughput, RayCounts& counts, const Met& met, const ScatteredAt& scattered_at) {
  const SceneTables& tables = scene.tables();
  const FloatN at_start = largest_of(magnitudes(throughput));
  const UintN key = mix_bits(RayIds{ids.pixel, ids.sample, 0x40000000U | ids.walk}.keys());
  const auto number = [&](int step, std::uint32_t what) {
    return to_unit(mix_bits(key + UintN((static_cast<std::uint32_t>(step) * 5 + what) * 0x9e3779b9U)));
  };
  MaskN seeing = ids.seeing;
  for (int step = 0; step < most_scatterings; ++step) {
    const Rgb<FloatN> light = magnitudes(throughput);
    walks = walks & (sum(light) > FloatN(0));
    if (none(walks)) return;
    rays.near = FloatN(0);
    const FloatN length = -log(FloatN(1) - number(step, 1)) / chosen(number(step, 0), light, scatterers.extinction);
    rays.far = select(walks, min(length, FloatN(1e17F)), rays.far);
    counts.indirect += count_lanes(walks);
    const std::uint32_t id = 0x80000000U | ids.walk << 14U | static_cast<std::uint32_t>(step);
    Hits hits = intersect(scene, rays, walks, {ids.pixel, ids.sample, id}, Coherence::incoherent, seeing);
    const Rgb<FloatN> left = exp_of(scatterers.extinction * -rays.far);
    const Rgb<FloatN> density = select(hits.hit, left, scatterers.extinction * left);
    const FloatN mean_density = sum(light * density) / sum(light);
    // It is 0 where rounding chose a colour that has no light.
    const FloatN scale = select(mean_density > FloatN(0), FloatN(1) / mean_density, FloatN(0));
    const Rgb<FloatN> kept = select(hits.hit, left, scatterers.albedo * density) * scale;
    throughput = select(walks, throughput * kept, throughput);

    const MaskN scatters = walks & !hits.hit;
    if (any(hits.hit)) {
      if (tables.has_motion()) [[unlikely]]
        hits.time = RayIds{ids.pixel, ids.sample, 0}.times();
      walks = walks & !met(rays, hits);
    }
    if (none(scatters)) continue;
    scattered_at(scatters);
    seeing = seeing & !scatters;
    rays.origin = select(scatters, rays.at(rays.far), rays.origin);
    const Vec3<FloatN> turned =
        sample_henyey_greenstein(rays.direction, scatterers.anisotropy, number(step, 2), number(step, 3));
    rays.direction = select(scatters, turned, rays.direction);
    const FloatN survival = min(largest_of(magnitudes(throughput)) / at_start * FloatN(4), FloatN(1));
    const MaskN at_stake = scatters & (survival < FloatN(1));
    throughput = select(at_stake, throughput * (FloatN(1) / max(survival, FloatN(1e-12F))), throughput);
    walks = walks & !(at_stake & (number(step, 4) >= survival));
  }
}

}  // namespace

Hits walk_below(const TracedScene& scene, const SubsurfaceEntry& entry, const MaskN& lanes, const WalkIds& ids,
                Ray<FloatN>& rays, Rgb<FloatN>& throughput, RayCounts& counts) {
  const SceneTables& tables = scene.tables();
  const Subsurface<FloatN>& inside = entry.inside;
  // Where there is no depth: what light from the other side would have hit.
  Hits result = entry.hits;
  result.hit = lanes & inside.is_sheet;
  Ray<FloatN> inner = rays;
  rays = {entry.surface.p, entry.surface.ng, FloatN(0), FloatN(0)};
  // A walk starts below the surface by a few times its error, which must be little beside a flight.
  const FloatN shortest = max(entry.surface.error * FloatN(256), FloatN(1e-30F));
  const Rgb<FloatN> extinction = inverse({max(inside.free_path.red, shortest), max(inside.free_path.green, shortest),
                                          max(inside.free_path.blue, shortest)});
  const IntN object = tables.object(entry.hits);
  IntN times_in(1);
  const auto met = [&](Ray<FloatN>& walked, const Hits& hits) {
    const SurfaceInteraction<FloatN> surface = scene.accelerator().surface(walked, hits);
    const MaskN is_own = hits.hit & float_mask<FloatN>(tables.object(hits) == object) &
                         float_mask<FloatN>(same_bits<IntN>(hits.instance) == same_bits<IntN>(entry.hits.instance));
    times_in = times_in + select_lanes(is_own, select_lanes(surface.front, IntN(1), IntN(-1)), IntN(0));
    const MaskN comes_out = is_own & float_mask<FloatN>(times_in <= IntN(0));
    if (any(comes_out)) {
      result = select(comes_out, hits, result);
      rays.origin = select(comes_out, surface.p, rays.origin);
      rays.direction = select(comes_out, -walked.direction, rays.direction);
    }
    walked.origin = select(hits.hit, offset_ray_origin(surface, hits.hit), walked.origin);
    return comes_out;
  };
  walk(scene, {extinction, inside.albedo, inside.anisotropy}, lanes & !inside.is_sheet, ids, inner, throughput, counts,
       met, [](const MaskN&) {});
  return result;
}

MediumWalk walk_through(const TracedScene& scene, const IntN& medium, const MaskN& lanes, const WalkIds& ids,
                        Ray<FloatN>& rays, Rgb<FloatN>& throughput, RayCounts& counts) {
  const MediumTable& media = scene.tables().media();
  MediumWalk result;
  result.hits = no_hits();
  const auto met = [&](const Ray<FloatN>&, const Hits& hits) {
    result.hits = any(result.hits.hit) ? select(hits.hit, hits, result.hits) : hits;
    return hits.hit;
  };
  // A flight must be able to leave the rounding of where it starts, however dense the medium.
  const Vec3<FloatN>& start = rays.origin;
  const FloatN most =
      FloatN(1) / max(max(max(abs(start.x), abs(start.y)), abs(start.z)) * FloatN(0x1p-20F), FloatN(1e-30F));
  const Rgb<FloatN> given = media.extinction(medium), albedo = media.albedo(medium);
  const Rgb<FloatN> extinction{min(given.red, most), min(given.green, most), min(given.blue, most)};
  const FloatN anisotropy = media.anisotropy(medium);
  Ray<FloatN> walked = rays;
  walk(scene, {extinction, albedo, anisotropy}, lanes, ids, walked, throughput, counts, met,
       [&](const MaskN& scattered) { result.scatters = result.scatters | scattered; });
  rays.origin = select(lanes, walked.origin, rays.origin);
  rays.direction = select(lanes, walked.direction, rays.direction);
  rays.far = select(lanes, walked.far, rays.far);
  return result;
}

}  // namespace raytrace
