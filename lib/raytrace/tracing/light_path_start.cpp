#include "raytrace/tracing/light_path_start.h"

#include <array>
#include <cstdint>
#include <numbers>

#include "raytrace/accel/surface_uv.h"
#include "raytrace/math/frame.h"
#include "raytrace/math/lanes.h"
#include "raytrace/math/turns.h"
#include "raytrace/math/unit_disk.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

namespace {

constexpr float two_pi = static_cast<float>(2 * std::numbers::pi);

IntN start_of(LightPathStart start) { return IntN(static_cast<std::int32_t>(start)); }

/// The targets' spheres.
struct Targets {
  Vec3<FloatN> center;
  FloatN radius;
};

/// Directions from the rays' origins into the cone around the target. Divides the light by their density.
void aim(LightPathPacket& path, const Targets& targets, const MaskN& lanes) {
  const Sample2D u = get_2d(path.pixel, path.sample, light_path_dimension(LightPathDraw::direction));
  const Vec3<FloatN> way = targets.center - path.rays.origin;
  const FloatN radius = targets.radius, distance2 = dot(way, way);
  const MaskN outside = distance2 > radius * radius;
  const FloatN sine2 = radius * radius / max(distance2, FloatN(1e-30F));
  const FloatN cone = select(outside, sine2 / (FloatN(1) + sqrt(max(FloatN(1) - sine2, FloatN(0)))), FloatN(2));
  const FloatN height = u.x * cone, across = sqrt(max(height * (FloatN(2) - height), FloatN(0)));
  const auto [sine, cosine] = sin_cos_of_turns(u.y);
  const Frame<FloatN> frame(unit_vector(select(outside, way, Vec3<FloatN>(Vec3f(0, 0, 1)))));
  path.rays.direction =
      select(lanes, frame.to_world({across * cosine, across * sine, FloatN(1) - height}), path.rays.direction);
  path.flux = select(lanes, path.flux * (cone * FloatN(two_pi)), path.flux);
}

/// Parallel rays onto the target, of those directions, from beyond all objects with bounds.
void start_far_away(const SceneTables& scene, LightPathPacket& path, const Targets& targets, const MaskN& lanes) {
  const Sample2D u = get_2d(path.pixel, path.sample, light_path_dimension(LightPathDraw::place));
  const DiskPoint<FloatN> disk = on_unit_disk(u.x, u.y);
  const FloatN radius = targets.radius;
  const Frame<FloatN> frame(path.rays.direction);
  const Vec3<FloatN> at = targets.center + (frame.x * disk.x + frame.y * disk.y) * radius;
  const BoundingSphere& all = scene.caustics()->scene_sphere();
  const FloatN back = length(at - Vec3<FloatN>(Vec3f(all.center))) + FloatN(static_cast<float>(all.radius));
  path.rays.origin = select(lanes, at - path.rays.direction * back, path.rays.origin);
  path.start = select_lanes(lanes, start_of(LightPathStart::far_away), path.start);
  path.flux = select(lanes, path.flux * (radius * radius * FloatN(two_pi / 2)), path.flux);
}

void start_at_source(const SceneTables& scene, LightPathPacket& path, const Targets& targets, std::int32_t source,
                     const MaskN& lanes) {
  path.group = select_lanes(lanes, IntN(scene.light_group(static_cast<std::size_t>(source))), path.group);
  const LightSource& light = *scene.lights()[static_cast<std::size_t>(source)];
  if (const auto location = light.location()) {
    path.rays.origin = select(lanes, Vec3<FloatN>(*location), path.rays.origin);
    path.flux = select(lanes, Rgb<FloatN>(Rgb<float>(1, 1, 1)), path.flux);
    path.start = select_lanes(lanes, start_of(LightPathStart::at_point), path.start);
    aim(path, targets, lanes);
    return;
  }
  Ray<FloatN> ray;
  ray.origin = targets.center;
  Rgb<FloatN> radiance;
  light.sample(ray, get_2d(path.pixel, path.sample, light_path_dimension(LightPathDraw::direction)), radiance);
  path.rays.direction = select(lanes, -unit_vector(ray.direction), path.rays.direction);
  path.flux = select(lanes, radiance, path.flux);
  start_far_away(scene, path, targets, lanes);
}

void start_at_patches(const SceneTables& scene, LightPathPacket& path, const Targets& targets, const MaskN& lanes) {
  const EmitterTable& emitters = scene.emitters();
  const auto first = static_cast<std::int32_t>(scene.lights().size());
  const IntN patch = select_lanes(lanes, path.source - IntN(first), IntN(0));
  // Places are drawn for a point of the target that no plane of a lamp is likely to go through; of spheres, whose far
  // sides such a point does not see, for one inside.
  Vec3<FloatN> from = targets.center + Vec3<FloatN>(Vec3f(0.137F, 0.271F, 0.391F)) * targets.radius;
  alignas(64) std::array<float, packet_lanes> x{}, y{}, z{}, is_inside{};
  for (std::size_t lane = 0; lane < packet_lanes; ++lane) {
    const PatchRecord<float>& record = emitters.patch(static_cast<std::size_t>(patch.get(lane)));
    const PatchShape shape = PatchCode::shape_of(record.code);
    if (shape != PatchShape::sphere && shape != PatchShape::ellipsoid) continue;
    const Vec3f up = shape == PatchShape::sphere ? Vec3f(0, 0, record.a.x) : Vec3f(record.b.y, record.b.x, record.a.z);
    x[lane] = record.origin.x + up.x * 0.25F;
    y[lane] = record.origin.y + up.y * 0.25F;
    z[lane] = record.origin.z + up.z * 0.25F;
    is_inside[lane] = 1;
  }
  const FloatN time = emitters.has_motion() ? RayIds{path.pixel, path.sample, 0}.times() : FloatN(0);
  const Vec3<FloatN> inside{FloatN::load_aligned(x.data()), FloatN::load_aligned(y.data()),
                            FloatN::load_aligned(z.data())};
  from = select(FloatN::load_aligned(is_inside.data()) > FloatN(0), emitters.to_world(patch, time, inside), from);
  const Sample2D place = get_2d(path.pixel, path.sample, light_path_dimension(LightPathDraw::place));
  const EmitterTable::Sample sample = emitters.sample(patch, from, time, place.x, place.y);
  path.group = select_lanes(lanes, scene.light_group_of_material(sample.material), path.group);
  const PatchSample& drawn = sample.point;
  // Per area, from per solid angle.
  const Vec3<FloatN> way = drawn.p - from;
  const FloatN distance2 = dot(way, way);
  const FloatN per_area = drawn.pdf * abs(dot(drawn.normal, way)) / (distance2 * sqrt(distance2));
  const MaskN good = lanes & (drawn.pdf < infinity<FloatN>()) & (per_area > FloatN(0));
  path.rays.origin = select(lanes, drawn.p, path.rays.origin);
  path.flux = select(good, Rgb<FloatN>(Rgb<float>(1, 1, 1)) * (FloatN(1) / per_area), path.flux);
  aim(path, targets, lanes);
  SurfaceInteraction<FloatN> light{};
  light.front = dot(drawn.normal, path.rays.direction) > FloatN(0);
  light.ng = light.ns = select(light.front, drawn.normal, -drawn.normal);
  light.wo = path.rays.direction;
  light.p = drawn.p;
  light.error = drawn.error;
  const Rgb<FloatN> radiance = scene.emitted(
      sample, good, light, [&](const Hits& hits) { return texture_point(scene, FloatN(0), hits, light); });
  path.rays.origin = select(lanes, offset_ray_origin(light), path.rays.origin);
  path.flux = select(lanes, path.flux * radiance * dot(light.ng, path.rays.direction), path.flux);
}

}  // namespace

MaskN start_light_paths(const SceneTables& scene, LightPathPacket& path) {
  const CausticTable& caustics = *scene.caustics();
  const Sample2D choice = get_2d(path.pixel, path.sample, light_path_dimension(LightPathDraw::source));
  alignas(64) std::array<float, packet_lanes> probabilities, x, y, z, radii;
  alignas(64) std::array<std::int32_t, packet_lanes> source_numbers, target_numbers;
  for (std::size_t lane = 0; lane < packet_lanes; ++lane) {
    const auto source = caustics.choose_source(choice.x.get(lane)), target = caustics.choose_target(choice.y.get(lane));
    source_numbers[lane] = source.number;
    target_numbers[lane] = target.number;
    const CausticTable::Target& sphere = caustics.target(target.number);
    x[lane] = sphere.center.x;
    y[lane] = sphere.center.y;
    z[lane] = sphere.center.z;
    radii[lane] = sphere.radius;
    probabilities[lane] = source.probability * target.probability;
  }
  const FloatN choices = FloatN::load_aligned(probabilities.data());
  path.flux = Rgb<FloatN>(Rgb<float>(0, 0, 0));
  path.rays.near = FloatN(0);
  path.rays.origin = path.rays.direction = Vec3<FloatN>(Vec3f(0, 0, 1));
  path.group = IntN(0);
  path.start = start_of(LightPathStart::on_surface);
  path.source = IntN::load_aligned(source_numbers.data());
  path.target = IntN::load_aligned(target_numbers.data());
  const IntN& source = path.source;
  const Targets targets{
      {FloatN::load_aligned(x.data()), FloatN::load_aligned(y.data()), FloatN::load_aligned(z.data())},
      FloatN::load_aligned(radii.data())};
  const auto lights = static_cast<std::int32_t>(scene.lights().size());
  const auto patches = static_cast<std::int32_t>(scene.emitters().size());
  for_each_value(source, float_mask<FloatN>(source < IntN(lights)),
                 [&](std::int32_t number, const MaskN& here) { start_at_source(scene, path, targets, number, here); });
  const MaskN at_patch =
      float_mask<FloatN>(source >= IntN(lights)) & float_mask<FloatN>(source < IntN(lights + patches));
  if (any(at_patch)) start_at_patches(scene, path, targets, at_patch);
  const MaskN far = float_mask<FloatN>(source >= IntN(lights + patches));
  if (any(far)) {
    const Sample2D place = get_2d(path.pixel, path.sample, light_path_dimension(LightPathDraw::direction));
    const EnvironmentSample sky = scene.environment()->sample(place.x, place.y);
    path.group = select_lanes(far, IntN(scene.environment_group()), path.group);
    path.rays.direction = select(far, -sky.wi, path.rays.direction);
    path.flux = select(far, sky.radiance * (FloatN(1) / sky.pdf), path.flux);
    start_far_away(scene, path, targets, far);
  }
  path.flux = path.flux * (FloatN(1) / choices);
  path.share = Rgb<FloatN>(Rgb<float>(1, 1, 1));
  path.deviation = FloatN(0);
  return largest(path.flux) > FloatN(0);
}

}  // namespace raytrace
