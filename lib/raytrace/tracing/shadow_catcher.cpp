#include "raytrace/tracing/shadow_catcher.h"

#include <numbers>
#include <variant>

#include "raytrace/accel/surface_uv.h"
#include "raytrace/bsdfs/direction_about.h"
#include "raytrace/sampling/reservoir.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/identified_rays.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

namespace {

/// So many candidates are drawn: powers of 2, so that those of a sample are well spread. The more there are, the nearer
/// the mean of A is to the share of the light that is hidden; the weights of points on a near surface differ most.
constexpr std::uint32_t emitter_candidates = 16, environment_candidates = 8;
/// So often a sample asks for light that no catcher hides. The more, the nearer A is to the share of that light where
/// catchers hide most of it.
constexpr std::uint32_t most_rounds = 4;
/// So many surfaces are looked at for a catcher behind them.
constexpr int most_surfaces = 64;

FloatN brightness_of(const Rgb<FloatN>& color) { return abs(color.red) + abs(color.green) + abs(color.blue); }

/// One of the candidates for each lane, in proportion to their weights: the irradiance from there.
struct LightChoice {
  Reservoir reservoir;
  Ray<FloatN> ray;        ///< to the one that is chosen
  MaskN may_hide{false};  ///< whether something in between counts

  void add(const FloatN& weight, const Ray<FloatN>& candidate, bool has_shadows) {
    const MaskN chosen = reservoir.add(weight);
    ray.direction = select(chosen, candidate.direction, ray.direction);
    ray.far = select(chosen, candidate.far, ray.far);
    may_hide = (may_hide & !chosen) | (chosen & MaskN(has_shadows));
  }
};

/// A point of a catcher that camera rays have met.
struct CatcherPoint {
  const SceneTables& tables;
  const CameraRays& camera;
  const SurfaceInteraction<FloatN>& surface;
  Ray<FloatN> ray;  ///< that starts there
  UintN pixel;      ///< of the draws: the camera's, another for each round

  /// The cosine of the light's angle with the surface, 0 where it comes from behind.
  FloatN cosine(const Vec3<FloatN>& wi) const {
    const FloatN of_normal = dot(surface.ns, wi);
    return select((of_normal > FloatN(0)) & (dot(surface.true_normal(), wi) > FloatN(0)), of_normal, FloatN(0));
  }
  /// Of a sample's candidate, which has so many.
  Sample2D draw(CatcherDraw what, std::uint32_t candidate, std::uint32_t count) const {
    return get_2d(pixel, camera.sample * UintN(count) + UintN(candidate), catcher_dimension(what));
  }
};

void add_lights(CatcherPoint& point, LightChoice& choice) {
  const SceneTables& tables = point.tables;
  Rgb<float> ambient(0, 0, 0);
  for (const SceneTables::LightGroup& group : tables.light_groups()) ambient += group.ambient_radiance;
  // It comes from all around, and nothing hides it.
  choice.add(brightness_of(Rgb<FloatN>(ambient)) * FloatN(std::numbers::pi_v<float>), point.ray, false);
  for (std::size_t i = 0; i < tables.lights().size(); ++i) {
    const LightSource& light = *tables.lights()[i];
    Sample2D place{FloatN(0), FloatN(0)};
    if (light.takes_samples())
      place = get_2d(point.pixel, point.camera.sample,
                     catcher_dimension(CatcherDraw::first_light, static_cast<std::uint32_t>(i)));
    Rgb<FloatN> radiance;
    light.sample(point.ray, place, radiance);
    choice.add(brightness_of(radiance) * point.cosine(normalize(point.ray.direction)), point.ray, light.shadows());
  }
}

void add_emitters(CatcherPoint& point, const Hits& hits, LightChoice& choice) {
  const SceneTables& tables = point.tables;
  if (tables.emitters().empty()) return;
  constexpr std::uint32_t count = emitter_candidates;
  for (std::uint32_t i = 0; i < count; ++i) {
    DrawnLight light;
    light.ray = point.ray;
    draw_from_surfaces(tables, point.surface, point.surface.ns, hits.time, point.draw(CatcherDraw::emitter, i, count).x,
                       point.draw(CatcherDraw::emitter_point, i, count), light);
    light.surface.wo = -light.wi;
    const FloatN cosine = point.cosine(light.wi);
    const MaskN lit = hits.hit & (light.pdf > FloatN(0)) & (cosine > FloatN(0));
    const Rgb<FloatN> radiance = tables.emitted(light.sample, lit, light.surface, [&](const Hits& there) {
      const FloatN distance = point.camera.skipped + point.camera.rays.far + length(light.ray.direction);
      return texture_point(tables, tables.ray_cone().half_width(distance), there, light.surface);
    });
    const FloatN density = light.pdf * FloatN(static_cast<float>(count));
    choice.add(select(lit, brightness_of(radiance) * cosine / density, FloatN(0)), light.ray, true);
  }
}

/// Half of its candidates as it draws them, half by the cosine, each by the balance heuristic. A background, which
/// lights what paths meet, has only the latter.
void add_environment(CatcherPoint& point, LightChoice& choice) {
  const SceneTables& tables = point.tables;
  const Environment* const environment = tables.environment();
  const Rgb<float> background(tables.viewplane().background);
  if (environment == nullptr && background.red == 0 && background.green == 0 && background.blue == 0) return;
  const std::uint32_t drawn = environment != nullptr ? environment_candidates / 2 : 0;
  const std::uint32_t by_cosine = environment_candidates - drawn;
  point.ray.far = infinity<FloatN>();
  const auto add = [&](const EnvironmentSample& sky) {
    const FloatN cosine = point.cosine(sky.wi);
    const FloatN density = FloatN(static_cast<float>(drawn)) * sky.pdf +
                           FloatN(static_cast<float>(by_cosine) * std::numbers::inv_pi_v<float>) * cosine;
    point.ray.direction = sky.wi;
    choice.add(select(cosine > FloatN(0), brightness_of(sky.radiance) * cosine / density, FloatN(0)), point.ray, true);
  };
  for (std::uint32_t i = 0; i < drawn; ++i) {
    const Sample2D u = point.draw(CatcherDraw::environment, i, drawn);
    add(environment->sample(u.x, u.y));
  }
  for (std::uint32_t i = 0; i < by_cosine; ++i) {
    const Sample2D u = point.draw(CatcherDraw::direction, i, by_cosine);
    const Vec3<FloatN> wi = direction_about(point.surface.ns, sqrt(FloatN(1) - u.y), sqrt(u.y), u.x);
    add(environment != nullptr ? environment->at(wi) : EnvironmentSample{wi, Rgb<FloatN>(background), FloatN(0)});
  }
}

/// The lanes whose rays a shadow catcher hides, whatever else does.
MaskN hidden_by_catchers(const TracedScene& scene, Ray<FloatN> rays, const MaskN& lanes, const RayIds& ids,
                         CaughtShadows& caught) {
  const FloatN far = rays.far;
  MaskN hidden(false), left = lanes;
  for (int i = 0; i < most_surfaces && any(left); ++i) {
    rays.far = far;
    caught.shadow_rays += count_lanes(left & caught.counted);
    const Hits hits = intersect(scene, rays, left, ids, Coherence::incoherent);
    const MaskN catches = hits.hit & scene.tables().geometry().shadow_catchers(hits);
    hidden = hidden | catches;
    left = hits.hit & !catches;
    rays.near = select(left, same_bits<FloatN>(same_bits<UintN>(rays.far) + UintN(1u)), rays.near);
  }
  return hidden;
}

}  // namespace

void CaughtShadows::add_to(RayResult& result, std::span<Rgb<FloatN>> groups, RayCounts& counts) const {
  counts.shadow += shadow_rays;
  if (none(shadowed)) return;
  const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
  result.radiance = select(shadowed, black, result.radiance);
  for (Rgb<FloatN>& group : groups) group = select(shadowed, black, group);
  result.hit = result.hit | shadowed;
}

bool integrator_catches_shadows(const SceneTables& tables) {
  return std::holds_alternative<Raycast::Parameters>(tables.integrator()) ||
         std::holds_alternative<Path::Parameters>(tables.integrator());
}

Hits catch_shadows(const TracedScene& scene, const CameraRays& camera, const Hits& hits) {
  const SceneTables& tables = scene.tables();
  CaughtShadows& caught = *camera.caught;
  caught.shadowed = MaskN(false);
  caught.shadow_rays = 0;
  if (none(hits.hit)) return hits;
  Hits on_catcher = hits, others = hits;
  on_catcher.hit = tables.geometry().shadow_catchers(hits);
  if (none(on_catcher.hit)) return hits;
  on_catcher.find_first();
  others.hit = hits.hit & !on_catcher.hit;
  others.find_first();

  const SurfaceInteraction<FloatN> surface = scene.accelerator().surface(camera.rays, on_catcher);
  const bool finds_paths = std::holds_alternative<Path::Parameters>(tables.integrator());
  const Ray<FloatN> start{offset_ray_origin(surface), surface.ng, FloatN(0), infinity<FloatN>()};
  const RayIds ids{camera.pixel, camera.sample, 0x10000000U};
  MaskN open = on_catcher.hit;  // what hides their light is not known yet
  for (std::uint32_t round = 0; round < most_rounds && any(open); ++round) {
    CatcherPoint point{tables, camera, surface, start, camera.pixel ^ UintN(round * 0x9E3779B9U)};
    const Sample2D drawn = get_2d(point.pixel, camera.sample, catcher_dimension(CatcherDraw::choice));
    LightChoice choice{Reservoir(drawn.x), point.ray};
    add_lights(point, choice);
    if (finds_paths) {  // all that rays are cast for is lights
      add_emitters(point, on_catcher, choice);
      add_environment(point, choice);
    }
    const MaskN lit = open & choice.may_hide;
    if (none(lit)) return others;
    caught.shadow_rays += count_lanes(lit & caught.counted);
    MaskN hidden;
    if (!tables.has_panes_for_surfaces()) [[likely]] {
      hidden = lit & occluded(scene, choice.ray, lit, ids, Coherence::coherent);
    } else {
      // Panes hide as much as they do not let through.
      const int most = std::get<Path::Parameters>(tables.integrator()).maxdepth - 1;
      const PanesAhead panes{IntN(most), {}, camera.skipped + camera.rays.far};
      Rgb<FloatN> left(Rgb<float>(1, 1, 1));
      const MaskN occluded = occluded_behind_panes(scene, choice.ray, lit, ids, Coherence::coherent, panes, left);
      const FloatN mean = (left.red + left.green + left.blue) * FloatN(1.0F / 3);
      hidden = lit & (occluded | (drawn.y >= mean));
    }
    // What catchers hide from each other is dark in the photograph already: such light does not count.
    open = hidden_by_catchers(scene, choice.ray, hidden, ids, caught);
    caught.shadowed = caught.shadowed | (hidden & !open);
  }
  return others;
}

}  // namespace raytrace
