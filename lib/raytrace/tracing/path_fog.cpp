// The ways of paths through fogs.
//
// On each part of its way in a fog, a path gets light at a distance that is drawn for that, and goes on by a free
// flight of its own. Lights at a point get half of their distances by the angles from which the light sees them, so
// that the halos of lamps are not noisier than what is far away from them (Kulla and Fajardo, "Importance Sampling
// Techniques for Path Tracing in Participating Media", EGSR 2012).
#include "raytrace/tracing/path_fog.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "raytrace/sampling/reservoir.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

void PathBatch::light_fog(const PathPacket& path, const FogPart& part, FogNumbers numbers, int depth,
                          RayCounts& counts) {
  const SceneTables& tables = scene_.tables();
  const FloatN begin = numbers(FogDraw::light).x, begin_of_drawn = numbers(FogDraw::flights).y;
  const float share = 1 / static_cast<float>(part.rounds);
  const Rgb<FloatN> scattered = path.throughput * part.scattering;
  const auto add_light = [&](const FogLight& light) {
    add_fog_light(path, part, light, numbers.ids(light.ray_number), scattered * FloatN(share),
                  path.distance + light.distance, depth, counts);
  };
  for (int round = 0; round < part.rounds; ++round) {
    numbers.round = static_cast<std::uint32_t>(round);
    const auto in_round = [&](const FloatN& u) { return (u + FloatN(static_cast<float>(round))) * FloatN(share); };
    if (!tables.lights().empty()) add_light(choose_light(path, part, numbers, in_round(begin)));
    if (tables.environment() != nullptr || !tables.emitters().empty())
      add_light(draw_light_in_fog(path, part, numbers, in_round(begin_of_drawn)));
  }
}

void PathBatch::add_fog_light(const PathPacket& path, const FogPart& part, const FogLight& light, const RayIds& ids,
                              const Rgb<FloatN>& scattered, const FloatN& distance, int depth, RayCounts& counts) {
  const SceneTables& tables = scene_.tables();
  MaskN lit = light.lit;
  if (none(lit)) return;
  Rgb<FloatN> left(Rgb<float>(1, 1, 1));
  if (const MaskN may_hide = lit & light.has_shadow; any(may_hide)) {
    counts.shadow += count_lanes(may_hide);
    const PanesAhead panes{IntN(settings_.maxdepth - depth - 1) - path.fog_scatterings, {}, distance};
    lit = lit & !(tables.has_panes()
                      ? occluded_behind_panes(scene_, light.ray, may_hide, ids, Coherence::incoherent, panes, left)
                      : occluded_identified(scene_, light.ray, may_hide, ids, Coherence::incoherent));
    if (none(lit)) return;
  }
  left = left * light_through(scene_, light.ray, lit, ids, {part.media, part.fog});
  add_from_fog(path, lit, scattered * light.radiance * left, light.group, depth);
}

DrawnLight PathBatch::draw_light_for(const Vec3<FloatN>& places, const MaskN& lanes, const FogNumbers& numbers) const {
  const SceneTables& tables = scene_.tables();
  SurfaceInteraction<FloatN> from{};
  from.p = places;
  from.ng = from.ns = Vec3<FloatN>(Vec3f(0, 0, 0));
  from.error = rounding_error(from.p, FloatN(0));
  const FloatN time = tables.emitters().has_motion() ? numbers.ids(0).times() : FloatN(0);
  DrawnLight light =
      draw_light(tables, from, from.ns, time, numbers(FogDraw::emitter), numbers(FogDraw::emitter_point));
  light.lit = light.lit & lanes;
  return light;
}

/// One of all lights that are not drawn from surfaces or the sky, at one of several distances.
PathBatch::FogLight PathBatch::choose_light(const PathPacket& path, const FogPart& part, const FogNumbers& numbers,
                                            const FloatN& u) const {
  const SceneTables& tables = scene_.tables();
  const Rgb<FloatN> scattered = path.throughput * part.scattering;
  Reservoir reservoir(numbers(FogDraw::choices).x);
  FogLight result;
  result.ray_number = 1;
  result.ray = {part.rays.origin, part.rays.direction, FloatN(0), FloatN(1)};
  FloatN weight(1);
  // What arrives along `ray`, whose origin is at that distance, which was drawn at that density.
  const auto offer = [&](const MaskN& lanes, const FloatN& distance, const FloatN& density, const Ray<FloatN>& ray,
                         const Rgb<FloatN>& arriving, const IntN& group, const MaskN& has_shadow) {
    const FloatN phase = part.phase(normalize(ray.direction));
    const Rgb<FloatN> radiance = arriving * (phase * part.left(distance) / density);
    const FloatN its_weight = select(lanes, brightness(scattered * radiance), FloatN(0));
    const MaskN chosen = reservoir.add(its_weight);
    if (none(chosen)) return;
    result.ray.origin = select(chosen, ray.origin, result.ray.origin);
    result.ray.direction = select(chosen, ray.direction, result.ray.direction);
    result.ray.far = select(chosen, ray.far, result.ray.far);
    result.distance = select(chosen, distance, result.distance);
    result.radiance = select(chosen, radiance, result.radiance);
    result.group = select_lanes(chosen, group, result.group);
    result.has_shadow = (result.has_shadow & !chosen) | (chosen & has_shadow);
    weight = select(chosen, its_weight, weight);
  };
  const Sample2D place = tables.has_sampled_lights() ? numbers(FogDraw::light_place) : Sample2D{};
  // The fewer lights, the more places.
  const std::size_t places = tables.lights().size() <= 2 ? 2 : 1;
  const FloatN share(1 / static_cast<float>(places));
  const auto ask = [&](std::size_t i) {
    const LightSource& light = *tables.lights()[i];
    const auto location = light.location();
    FloatN begin = part.begin, end = part.end;
    light.cut_to_lit(part.rays, begin, end);
    const MaskN lanes = part.lanes & (begin < end);
    if (none(lanes)) return;
    const FlightDistances flights(part.extinction, begin, end);
    std::optional<EquiangularDistances> angles;
    if (location) angles.emplace(part.rays, begin, end, Vec3<FloatN>(*location));
    const auto try_at = [&](const FloatN& distance) {
      FloatN density = flights.pdf(distance);
      if (angles) density = density + angles->pdf(distance);
      Ray<FloatN> ray{part.rays.at(distance), {}, FloatN(0), FloatN(1)};
      Rgb<FloatN> arriving;
      light.sample(ray, place, arriving);
      offer(lanes, distance, density / share, ray, arriving, IntN(tables.light_group(i)), MaskN(light.shadows()));
    };
    for (std::size_t j = 0; j < places; ++j) {
      const FloatN of_place = (u + FloatN(static_cast<float>(j))) * share;
      try_at(flights.sample(of_place));
      if (angles) try_at(angles->sample(of_place));
    }
  };
  const FloatN distance = part.flights.sample(u);
  for (std::size_t group = 0; group < groups_; ++group) {
    const SceneTables::LightGroup& lights = tables.light_groups()[group];
    const bool draws = lights.last_light - lights.first_drawn > most_asked_in_fog;
    for (std::size_t i = lights.first_light; i < (draws ? lights.first_drawn : lights.last_light); ++i) ask(i);
    if (!draws) continue;
    // Some that are together, as they matter at one of the distances.
    const Vec3<FloatN> nowhere(Vec3f(0, 0, 0));
    const ManyLights::Leaf leaf = lights.drawn->choose(part.rays.at(distance), nowhere, numbers(FogDraw::light).y);
    for (std::size_t i = 0; i < leaf.size; ++i) {
      const IntN light = leaf.first + IntN(static_cast<std::int32_t>(i));
      const PointSource<FloatN> source = lights.drawn->source(light);
      const EquiangularDistances angles(part.rays, part.begin, part.end, source.location);
      const auto try_at = [&](const FloatN& at) {
        Ray<FloatN> ray{part.rays.at(at), {}, FloatN(0), FloatN(1)};
        const Rgb<FloatN> arriving = lights.drawn->sample(light, source, ray);
        offer(part.lanes & (leaf.probability > FloatN(0)), at,
              (part.flights.pdf(at) + angles.pdf(at)) * leaf.probability, ray, arriving,
              IntN(static_cast<std::int32_t>(group)), lights.drawn->has_shadow(light));
      };
      try_at(distance);
      try_at(angles.sample(u));
    }
  }
  result.lit = part.lanes & (reservoir.total() > FloatN(0));
  result.radiance = result.radiance * (reservoir.total() / weight);
  return result;
}

/// Of a surface that shines, or of the sky.
PathBatch::FogLight PathBatch::draw_light_in_fog(const PathPacket& path, const FogPart& part, const FogNumbers& numbers,
                                                 const FloatN& u) const {
  const SceneTables& tables = scene_.tables();
  const FloatN distance = part.flights.sample(u);
  const DrawnLight light = draw_light_for(part.rays.at(distance), part.lanes, numbers);
  FogLight result;
  if (none(light.lit)) return result;
  result.ray_number = 2;
  result.ray = light.ray;
  result.distance = distance;
  result.has_shadow = MaskN(true);
  // Paths that are scattered there come to the light as well.
  const FloatN phase = part.phase(light.wi), density = light.pdf * part.flights.pdf(distance);
  const FloatN of_paths = phase * part.flights.pdf(distance) * part.flights.share();
  const FloatN weight = phase * part.left(distance) / density *
                        power_heuristic(density * FloatN(static_cast<float>(part.rounds)), of_paths);
  result.radiance = radiance_of(tables, light, path.distance + distance) * weight;
  result.lit = light.lit & (largest(result.radiance) > FloatN(0));
  if (groups_ > 1) result.group = group_of(light);
  return result;
}

/// What all of the part sends along it, whose share of flights ends there.
void PathBatch::add_emission(const PathPacket& path, const FogPart& part, int depth) {
  const FloatN share = share_of_depth(part.extinction * (part.end - part.begin));
  const Rgb<FloatN> radiance = path.throughput * scene_.tables().media().emission(part.fog) * share;
  const MaskN sends = part.lanes & (largest(radiance) > FloatN(0));
  if (none(sends)) return;
  add_scattered(path, sends, radiance, IntN(0), depth);
  if (has_passes_) add_to_passes(path, path.first, sends, radiance, depth);
}

MaskN PathBatch::scatter_in_fog(PathPacket& path, const FogPart& part, const FogNumbers& numbers, int depth) {
  const FloatN distance = part.begin + depth_of_share(numbers(FogDraw::flights).x) / part.extinction;
  const MaskN ends = part.lanes & (distance < part.end);
  if (none(ends)) return ends;
  const Sample2D u = numbers(FogDraw::direction);
  const Vec3<FloatN> wi = sample_henyey_greenstein(part.rays.direction, part.anisotropy, u.x, u.y);
  // Over the density of the places that lights are drawn for, of all rounds.
  const FloatN of_rounds(1 / static_cast<float>(part.rounds));
  path.pdf = select(ends, part.phase(wi) * part.flights.share() * of_rounds, path.pdf);
  path.from = select(ends, part.rays.at(distance), path.from);
  path.from_normal = select(ends, Vec3<FloatN>(Vec3f(0, 0, 0)), path.from_normal);
  path.throughput = select(ends, path.throughput * part.scattering * (FloatN(1) / part.extinction), path.throughput);
  path.distance = select(ends, path.distance + distance, path.distance);
  path.way = select_lanes(ends, IntN(depth == 0 ? by_scattering : any_way), path.way);
  path.fog_scatterings = select_lanes(ends, path.fog_scatterings + IntN(1), path.fog_scatterings);
  path.rays.direction = select(ends, wi, path.rays.direction);
  return ends;
}

Hits PathBatch::go_through_fog(PathPacket& path, MediumStack& media, const MaskN& lanes, const FogWay& way,
                               RayCounts& counts) {
  const SceneTables& tables = scene_.tables();
  Ray<FloatN>& rays = path.rays;
  Hits result = no_hits();
  MaskN goes_on = lanes, fogged(false), scattered(false);
  for (std::uint32_t step = 0; any(goes_on); ++step) {
    FogNumbers numbers{path.pixel, path.sample, way.number, step};
    const MaskN seeing = step == 0 ? seen_by(path, way.depth) : MaskN(false);
    Hits hits;
    if (step == 0 && way.first_hits != nullptr) {
      hits = *way.first_hits;
      hits.hit = hits.hit & goes_on;
    } else {
      Ray<FloatN> ray{rays.origin, rays.direction, FloatN(0), infinity<FloatN>()};
      const RayIds ids = numbers.ids(0);
      RayIdentity identity(tables, scene_.accelerator(), ray, ids);
      identity.set_seeing(seeing);
      counts.indirect += count_lanes(goes_on);
      hits = scene_.accelerator().intersect(ray, goes_on, Coherence::incoherent, nullptr, &identity);
      rays.near = FloatN(0);
      rays.far = select(goes_on, ray.far, rays.far);
    }
    MaskN scatters(false), ends(false);
    Ray<FloatN> ray = rays;
    if (step == 0) {
      const MaskN through = goes_on & way.through;
      if (any(through)) pass_boundaries_at_starts(scene_, ray, through, path.distance, numbers.ids(0), media);
    }
    for_each_part_in_fog(
        scene_, ray, goes_on, numbers.ids(0), media, seeing,
        [&](const MaskN& in_fog, const IntN& fog, int number, const FloatN& begin, const FloatN& end) {
          FogPart part(tables.media(), in_fog, ray, begin, end, fog, media);
          // What the camera sees first has most of the noise, and a shadow ray costs less than a path.
          if (way.depth == 0 && step == 0) part.rounds = 4;
          numbers.part = static_cast<std::uint32_t>(number);
          fogged = fogged | in_fog;
          const MaskN may_scatter =
              in_fog & float_mask<FloatN>(path.fog_scatterings < IntN(settings_.maxdepth - way.depth));
          MaskN here(false);
          if (tables.media().has_densities()) [[unlikely]] {
            FogPart uneven = part;
            uneven.lanes = in_fog & tables.media().has_density(fog);
            part.lanes = in_fog & !uneven.lanes;
            if (any(uneven.lanes)) here = go_through_density(path, uneven, may_scatter, numbers, way.depth, counts);
          }
          if (any(part.lanes)) {
            FogPart lit = part;
            lit.lanes = part.lanes & may_scatter;
            if (any(lit.lanes)) light_fog(path, lit, numbers, way.depth, counts);
            if (tables.media().has_emission()) [[unlikely]]
              add_emission(path, part, way.depth);
            here = here | scatter_in_fog(path, part, numbers, way.depth);
          }
          if (has_passes_) [[unlikely]]
            set_first(path, here, IntN(in_volume));
          scatters = scatters | (here & may_scatter);
          ends = ends | here;
          // Those that have been scattered often, or carry little.
          const FloatN survival = min(largest(path.throughput) * path.eta2 * FloatN(2), FloatN(1));
          const MaskN at_stake =
              here & float_mask<FloatN>(path.fog_scatterings > IntN(settings_.roulettedepth - way.depth));
          path.throughput =
              select(at_stake, path.throughput * (FloatN(1) / max(survival, FloatN(1e-12F))), path.throughput);
          scatters = scatters & !(at_stake & (numbers(FogDraw::choices).y >= survival));
          rays.origin = select(here, path.from, rays.origin);
          return in_fog & !here;
        });
    scattered = scattered | ends;
    const MaskN arrives = hits.hit & !ends;
    if (any(arrives)) {
      hits.hit = arrives;
      result = any(result.hit) ? select(arrives, hits, result) : hits;
      result.find_first();
    }
    MaskN escapes = goes_on & !ends & !arrives;
    // What the camera sees behind fogs is no part of a transparent picture's colour.
    if (way.first_hits != nullptr && step == 0) escapes = is_transparent_ ? MaskN(false) : escapes & fogged;
    if (any(escapes)) add_escaped(path, escapes, way.depth);
    goes_on = scatters & (largest(path.throughput) > FloatN(0));
  }
  if (way.fogged != nullptr) *way.fogged = is_transparent_ ? scattered : fogged;
  const MediumStack::Packed packed = media.packed();
  path.first_media = select_lanes(lanes, packed.first, path.first_media);
  path.last_media = select_lanes(lanes, packed.last, path.last_media);
  return result;
}

}  // namespace raytrace
