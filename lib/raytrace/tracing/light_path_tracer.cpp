#include "raytrace/tracing/light_path_tracer.h"

#include <cstddef>
#include <utility>
#include <variant>

#include "raytrace/math/frame.h"
#include "raytrace/math/lanes.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/fog.h"
#include "raytrace/tracing/identified_rays.h"
#include "raytrace/tracing/media.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

LightPathTracer::LightPathTracer(const TracedScene& scene, int most_points, StageClock& clock)
    : scene_(scene),
      tables_(scene.tables()),
      caustics_(*tables_.caustics()),
      most_points_(most_points),
      roulette_depth_(std::get<Path::Parameters>(tables_.integrator()).roulettedepth),
      clock_(clock),
      paths_(most_paths, LightPathPacket::unused(tables_.media())),
      next_(most_paths, LightPathPacket::unused(tables_.media())) {}

Hits LightPathTracer::intersect(LightPathPacket& path, MediumStack& media, int depth, Ray<FloatN>& rays,
                                const MaskN& lanes, RayCounts& counts) const {
  counts.indirect += count_lanes(lanes);
  rays.far = infinity<FloatN>();
  const RayIds ids = ray_ids(path, static_cast<std::uint32_t>(depth) * 2);
  const Hits hits = raytrace::intersect(scene_, rays, lanes, ids, Coherence::incoherent);
  if (tables_.media().has_fog() && any(hits.hit)) [[unlikely]] {
    const Rgb<FloatN> left = fog_transmittance(scene_, rays, hits.hit, ids, media);
    path.flux = select(hits.hit, path.flux * left, path.flux);
  }
  return hits;
}

void LightPathTracer::append(Chunk& chunk, LightPathPacket& path, const MediumStack& media, const Hits& hits,
                             const IntN& material, const MaskN& lanes) {
  path.set_hits(hits);
  path.set_media(media);
  chunk.append(path, lanes, bucket_of(hits, material));
}

void LightPathTracer::begin(const UintN& pixel, const UintN& sample, const IntN& column, const IntN& row,
                            const MaskN& lanes, RayCounts& rays) {
  if (most_points_ < 1) return;
  LightPathPacket path;
  path.pixel = pixel;
  path.sample = sample;
  path.column = column;
  path.row = row;
  const MaskN lit = lanes & start_light_paths(tables_, path);
  if (none(lit)) return;
  MediumStack media = scene_.light_media(path.rays.origin, lit, ray_ids(path, 0));
  const Hits hits = intersect(path, media, 0, path.rays, lit, rays);
  const IntN material = tables_.material(hits);
  // Other targets' paths are aimed at these. What lies inside of a medium may not be there.
  const MaskN comes = float_mask<FloatN>(caustics_.target_of(tables_.geometry(), hits, material) == path.target);
  append(paths_, path, media, hits, material, hits.hit & (comes | media.is_in_any()));
  if (paths_.is_full()) follow(rays);
}

void LightPathTracer::follow(RayCounts& rays) {
  clock_.end(Stage::light_paths);
  for (int depth = 0; paths_.size() > 0; ++depth) {
    paths_.sort(order_);
    next_.clear();
    for (std::size_t first = 0; first < order_.size(); first += packet_lanes) {
      clock_.begin_packet();
      auto [path, lanes] = paths_.load(order_, first);
      extend(path, lanes, depth, rays);
      clock_.end(Stage::light_paths);
    }
    std::swap(paths_, next_);
  }
}

void LightPathTracer::extend(LightPathPacket& path, MaskN alive, int depth, RayCounts& counts) {
  const Vec3<FloatN> from = path.rays.origin;
  Hits hits = path.hits(alive);
  if (tables_.has_motion()) [[unlikely]]
    hits.time = ray_ids(path, 0).times();
  SurfaceInteraction<FloatN> surface = scene_.accelerator().surface(path.rays, hits);
  MediumBoundary boundary;
  MediumStack media;
  if (!tables_.media().empty()) {
    media = path.media();
    const auto went = [&](const MaskN& lanes, const Rgb<FloatN>& left) {
      path.flux = select(lanes, path.flux * left, path.flux);
    };
    boundary = next_boundary(
        scene_, media, path.rays, hits, surface, went, [] { return FloatN(0); },
        [&](Ray<FloatN>& rays, const MaskN& lanes) { return intersect(path, media, depth, rays, lanes, counts); },
        false);
    if (none(hits.hit)) return;
    if (tables_.media().disperses()) [[unlikely]] {
      const Rgb<FloatN> weights = disperse(tables_.media(), boundary, alive & hits.hit, path.pixel, path.sample,
                                           light_path_wavelength_dimension, path.deviation);
      path.flux = path.flux * weights;
      path.share = path.share * weights;
    }
  }
  const SurfaceInteraction<FloatN> plain = surface;  // without relief, which the camera sees at its own footprint
  // Hardly more than a point: what bumps need for a slope.
  const auto textures = add_textures(tables_, hits, surface, [&] {
    return max(max(abs(surface.p.x), abs(surface.p.y)), abs(surface.p.z)) * FloatN(0x1p-14F);
  });
  const IntN target = caustics_.target_of(tables_.geometry(), hits, tables_.material(hits));
  alive = alive & hits.hit;
  if (depth == 0) alive = arrive_first(path, from, surface, alive & float_mask<FloatN>(target == path.target));
  const TexturePoint<FloatN>* const point = textures ? &*textures : nullptr;
  const MaskN focuses = float_mask<FloatN>(target >= IntN(0));
  if (const MaskN scattered = alive & !focuses; any(scattered))
    arrive({path, depth, media, hits, plain, boundary}, scattered);
  alive = alive & focuses;
  // So many points scatter on a path at most, the last of them to the camera.
  if (depth + 2 > most_points_ || none(alive)) return;
  alive = scatter(path, media, depth, hits, surface, boundary, point, alive);
  if (none(alive)) return;
  if (const MaskN through = alive & (dot(path.rays.direction, surface.ng) < FloatN(0));
      tables_.media().has_fog() && any(through)) [[unlikely]] {
    const RayIds ids = ray_ids(path, static_cast<std::uint32_t>(depth + 1) * 2);
    pass_boundaries_at_starts(scene_, path.rays, through, length(surface.p - from), ids, media);
  }
  const Hits next = intersect(path, media, depth + 1, path.rays, alive, counts);
  append(next_, path, media, next, tables_.material(next), alive & next.hit);
}

MaskN LightPathTracer::arrive_first(LightPathPacket& path, const Vec3<FloatN>& from,
                                    const SurfaceInteraction<FloatN>& surface, const MaskN& lanes) const {
  const auto starts = [&](LightPathStart start) {
    return lanes & float_mask<FloatN>(path.start == IntN(static_cast<std::int32_t>(start)));
  };
  for_each_value(path.source, starts(LightPathStart::at_point), [&](std::int32_t number, const MaskN& here) {
    Ray<FloatN> ray;
    ray.origin = surface.p;
    Rgb<FloatN> irradiance;
    tables_.lights()[static_cast<std::size_t>(number)]->sample(ray, {FloatN(0), FloatN(0)}, irradiance);
    const Vec3<FloatN> way = surface.p - from;
    path.flux = select(here, path.flux * irradiance * dot(way, way), path.flux);
  });
  // What came from far away has not met planes beyond all else.
  const MaskN far = starts(LightPathStart::far_away);
  if (none(far)) return lanes;
  const Ray<FloatN> back{from, -path.rays.direction, FloatN(0), infinity<FloatN>()};
  const MaskN hidden = occluded(scene_, back, far, ray_ids(path, ~0U >> 2U), Coherence::incoherent);
  return lanes & !hidden;
}

/// On to the next points. BSDFs are asked the other way round than on paths from the camera: for the direction that
/// light comes from, of which they draw one that it goes to.
MaskN LightPathTracer::scatter(LightPathPacket& path, MediumStack& media, int depth, const Hits& hits,
                               const SurfaceInteraction<FloatN>& surface, const MediumBoundary& boundary,
                               const TexturePoint<FloatN>* point, const MaskN& lanes) const {
  const Frame<FloatN> frame = tables_.shading_frame(hits, surface, point);
  const Vec3<FloatN> wi = frame.to_local(surface.wo);
  const auto draw = [&](LightPathPointDraw what) {
    return get_2d(path.pixel, path.sample, light_path_dimension(depth, what));
  };
  const Sample2D u = draw(LightPathPointDraw::direction), choice = draw(LightPathPointDraw::lobe_and_roulette);
  const BsdfSample<FloatN> sample =
      tables_.scatter(hits, surface, frame, boundary.media, wi, MaskN(false), wi, choice.x, u.x, u.y, point).sample;
  const Vec3<FloatN> wo = frame.to_world(sample.wi);
  const MaskN through = sample.wi.z < FloatN(0);
  const FloatN true_wi = dot(surface.wo, surface.ng), true_wo = dot(wo, surface.ng);
  MaskN alive = lanes & (sample.pdf > FloatN(0)) & (wi.z > FloatN(0)) & (true_wo * sample.wi.z > FloatN(0));
  // f of the two directions is that of the way back, but for the squeezing of radiance where it is refracted. Where
  // many facets share the light, f is not quite the same both ways: there, that of this way.
  Rgb<FloatN> f = sample.f * sample.eta2;
  // A base with relief has a normal of its own: both cosines are about that. Mirrored, they are one.
  if (surface.has_layers) {
    const Vec3<FloatN>& base = surface.layers.base;
    const FloatN mirrored = sample.wi.z / max(wi.z, FloatN(1e-6F));
    const FloatN of_base = max(dot(surface.wo, base), FloatN(0)) / max(-dot(wo, base), FloatN(1e-6F));
    f = select(surface.layers.lanes & sample.specular & !through, f * mirrored, f);
    f = select(surface.layers.lanes & through, f * (of_base * -mirrored), f);
  }
  if (const MaskN rough = alive & !sample.specular & !through; any(rough)) {
    const auto back =
        tables_.scatter(hits, surface, frame, boundary.media, sample.wi, rough, wi, choice.x, u.x, u.y, point).towards;
    f = select(rough, back.f, f);
  }
  // Of shading normals: Veach 1997, section 5.3.
  FloatN weight =
      abs(sample.wi.z) / sample.pdf * (wi.z * abs(true_wo) / max(true_wi * abs(sample.wi.z), FloatN(1e-6F)));
  if (surface.has_relief) weight = select(through, weight, weight * relief_shadow(surface, surface.wo));
  const Rgb<FloatN> factor = f * weight;
  path.flux = select(alive, path.flux * factor, path.flux);
  path.share = select(alive, path.share * factor, path.share);
  if (depth + 1 >= roulette_depth_) {
    const FloatN survival = min(largest(path.share) * FloatN(2), FloatN(1));
    const FloatN more = FloatN(1) / max(survival, FloatN(1e-12F));
    path.flux = path.flux * more;
    path.share = path.share * more;
    alive = alive & (choice.y < survival);
  }
  boundary.cross(media, through & alive, surface.front);
  path.rays.origin = offset_ray_origin(surface, through & alive);
  path.rays.direction = select(alive, wo, path.rays.direction);
  return alive & (largest(path.flux) > FloatN(0));
}

}  // namespace raytrace
