// The ways of paths through fogs that are not the same everywhere.
//
// A path flies to where the density has it scattered, and gets light there. Where the camera looks first, several
// flights get light, and the path goes on by the first of them. Directions that paths are scattered to find surfaces
// that shine and the sky as well; both are weighted as at a surface.
#include <cstddef>

#include "raytrace/sampling/reservoir.h"
#include "raytrace/tracing/density_walk.h"
#include "raytrace/tracing/path_fog.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

/// Where flights end.
struct PathBatch::FogPoint {
  MaskN lanes;
  FloatN distance;
  Vec3<FloatN> place;
};

MaskN PathBatch::go_through_density(PathPacket& path, const FogPart& part, const MaskN& may_scatter, FogNumbers numbers,
                                    int depth, RayCounts& counts) {
  const MediumTable& media = scene_.tables().media();
  const Rgb<FloatN> color = media.albedo(part.fog);
  FogPoint first{};
  for (int round = 0; round < part.rounds; ++round) {
    numbers.round = static_cast<std::uint32_t>(round);
    const FloatN u = numbers(FogDraw::flights).x;
    const UintN key = numbers.ids_of_round(0).keys();
    FogPoint point{MaskN(false), FloatN(0), {}};
    for_each_value(media.density(part.fog), part.lanes, [&](std::int32_t number, const MaskN& here) {
      const DensityFlight flight =
          fly(scene_.tables().densities()[number], part.rays, here, part.begin, part.end, u, key);
      point.lanes = point.lanes | flight.ends;
      point.distance = select(here, flight.distance, point.distance);
    });
    point.place = part.rays.at(point.distance);
    if (media.has_emission() && any(point.lanes)) [[unlikely]] {
      const Rgb<FloatN> radiance =
          path.throughput * media.emission(part.fog) * FloatN(1 / static_cast<float>(part.rounds));
      add_scattered(path, point.lanes, radiance, IntN(0), depth);
      if (has_passes_) add_to_passes(path, path.first, point.lanes, radiance, depth);
    }
    if (round == 0) first = point;
    point.lanes = point.lanes & may_scatter;
    if (any(point.lanes)) light_fog_point(path, part, point, color, numbers, depth, counts);
  }
  const MaskN& ends = first.lanes;
  if (none(ends)) return ends;
  numbers.round = 0;
  const Sample2D u = numbers(FogDraw::direction);
  const Vec3<FloatN> wi = sample_henyey_greenstein(part.rays.direction, part.anisotropy, u.x, u.y);
  // Over how often light is drawn for the place.
  const FloatN of_rounds(1 / static_cast<float>(part.rounds));
  path.pdf = select(ends, part.phase(wi) * of_rounds, path.pdf);
  path.from = select(ends, first.place, path.from);
  path.from_normal = select(ends, Vec3<FloatN>(Vec3f(0, 0, 0)), path.from_normal);
  path.throughput = select(ends, path.throughput * color, path.throughput);
  path.distance = select(ends, path.distance + first.distance, path.distance);
  path.way = select_lanes(ends, IntN(depth == 0 ? by_scattering : any_way), path.way);
  path.fog_scatterings = select_lanes(ends, path.fog_scatterings + IntN(1), path.fog_scatterings);
  path.rays.direction = select(ends, wi, path.rays.direction);
  return ends;
}

void PathBatch::light_fog_point(const PathPacket& path, const FogPart& part, const FogPoint& point,
                                const Rgb<FloatN>& color, const FogNumbers& numbers, int depth, RayCounts& counts) {
  const SceneTables& tables = scene_.tables();
  const Rgb<FloatN> scattered = path.throughput * color * FloatN(1 / static_cast<float>(part.rounds));
  const auto add_light = [&](const FogLight& light) {
    add_fog_light(path, part, light, numbers.ids_of_round(light.ray_number), scattered, path.distance + point.distance,
                  depth, counts);
  };
  if (!tables.lights().empty()) add_light(choose_light_at(part, point, scattered, numbers));
  if (tables.environment() != nullptr || !tables.emitters().empty())
    add_light(draw_light_at(path, part, point, numbers));
}

/// One of all lights that are not drawn from surfaces or the sky.
PathBatch::FogLight PathBatch::choose_light_at(const FogPart& part, const FogPoint& point, const Rgb<FloatN>& scattered,
                                               const FogNumbers& numbers) const {
  const SceneTables& tables = scene_.tables();
  Reservoir reservoir(numbers(FogDraw::choices).x);
  FogLight result;
  result.ray_number = 1;
  result.ray = {point.place, part.rays.direction, FloatN(0), FloatN(1)};
  FloatN weight(1);
  const auto offer = [&](const MaskN& lanes, const Ray<FloatN>& ray, const Rgb<FloatN>& arriving, const IntN& group,
                         const MaskN& has_shadow) {
    const Rgb<FloatN> radiance = arriving * part.phase(normalize(ray.direction));
    const FloatN its_weight = select(lanes, brightness(scattered * radiance), FloatN(0));
    const MaskN chosen = reservoir.add(its_weight);
    if (none(chosen)) return;
    result.ray.direction = select(chosen, ray.direction, result.ray.direction);
    result.ray.far = select(chosen, ray.far, result.ray.far);
    result.radiance = select(chosen, radiance, result.radiance);
    result.group = select_lanes(chosen, group, result.group);
    result.has_shadow = (result.has_shadow & !chosen) | (chosen & has_shadow);
    weight = select(chosen, its_weight, weight);
  };
  const Sample2D place = tables.has_sampled_lights() ? numbers(FogDraw::light_place) : Sample2D{};
  const auto to_light = [&] { return Ray<FloatN>{point.place, {}, FloatN(0), FloatN(1)}; };
  for (std::size_t group = 0; group < groups_; ++group) {
    const SceneTables::LightGroup& lights = tables.light_groups()[group];
    const bool draws = lights.last_light - lights.first_drawn > most_asked_in_fog;
    for (std::size_t i = lights.first_light; i < (draws ? lights.first_drawn : lights.last_light); ++i) {
      Ray<FloatN> ray = to_light();
      Rgb<FloatN> arriving;
      tables.lights()[i]->sample(ray, place, arriving);
      offer(point.lanes, ray, arriving, IntN(tables.light_group(i)), MaskN(tables.lights()[i]->shadows()));
    }
    if (!draws) continue;
    const Vec3<FloatN> nowhere(Vec3f(0, 0, 0));
    const ManyLights::Leaf leaf = lights.drawn->choose(point.place, nowhere, numbers(FogDraw::light).y);
    for (std::size_t i = 0; i < leaf.size; ++i) {
      const IntN light = leaf.first + IntN(static_cast<std::int32_t>(i));
      Ray<FloatN> ray = to_light();
      const Rgb<FloatN> arriving = lights.drawn->sample(light, lights.drawn->source(light), ray);
      offer(point.lanes & (leaf.probability > FloatN(0)), ray, arriving * (FloatN(1) / leaf.probability),
            IntN(static_cast<std::int32_t>(group)), lights.drawn->has_shadow(light));
    }
  }
  result.lit = point.lanes & (reservoir.total() > FloatN(0));
  result.radiance = result.radiance * (reservoir.total() / weight);
  return result;
}

/// Of a surface that shines, or of the sky.
PathBatch::FogLight PathBatch::draw_light_at(const PathPacket& path, const FogPart& part, const FogPoint& point,
                                             const FogNumbers& numbers) const {
  const SceneTables& tables = scene_.tables();
  const DrawnLight light = draw_light_for(point.place, point.lanes, numbers);
  FogLight result;
  if (none(light.lit)) return result;
  result.ray_number = 2;
  result.ray = light.ray;
  result.has_shadow = MaskN(true);
  // Paths that are scattered there come to the light as well.
  const FloatN phase = part.phase(light.wi), rounds(static_cast<float>(part.rounds));
  result.radiance = radiance_of(tables, light, path.distance + point.distance) *
                    (phase / light.pdf * power_heuristic(light.pdf * rounds, phase));
  result.lit = light.lit & (largest(result.radiance) > FloatN(0));
  if (groups_ > 1) result.group = group_of(light);
  return result;
}

}  // namespace raytrace
