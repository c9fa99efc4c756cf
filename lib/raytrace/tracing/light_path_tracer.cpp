#include "raytrace/tracing/light_path_tracer.h"

#include <bit>
#include <cstddef>
#include <variant>

#include "raytrace/math/frame.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/fog.h"
#include "raytrace/tracing/media.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

LightPathTracer::LightPathTracer(const TracedScene& scene, int most_points)
    : scene_(scene),
      tables_(scene.tables()),
      caustics_(*tables_.caustics()),
      most_points_(most_points),
      roulette_depth_(std::get<Path::Parameters>(tables_.integrator()).roulettedepth) {}

Hits LightPathTracer::intersect(LightPathPacket& path, Ray<FloatN>& rays, const MaskN& lanes) {
  rays_->indirect += count_lanes(lanes);
  rays.far = infinity<FloatN>();
  if (!tables_.identifies_rays()) return scene_.accelerator().intersect(rays, lanes, Coherence::incoherent);
  const RayIds ids = ray_ids(path, static_cast<std::uint32_t>(path.depth) * 2);
  const RayIdentity identity(tables_, scene_.accelerator(), rays, ids);
  const Hits hits = scene_.accelerator().intersect(rays, lanes, Coherence::incoherent, nullptr, &identity);
  if (tables_.media().has_fog() && any(hits.hit)) [[unlikely]] {
    const Rgb<FloatN> left = fog_transmittance(scene_, rays, hits.hit, ids, path.media);
    path.flux = select(hits.hit, path.flux * left, path.flux);
  }
  return hits;
}

void LightPathTracer::follow(LightPathPacket& path, MaskN alive, RayCounts& rays) {
  rays_ = &rays;
  path.share = Rgb<FloatN>(Rgb<float>(1, 1, 1));
  path.media = scene_.light_media(path.rays.origin, alive);
  path.deviation = FloatN(0);
  const auto lights = static_cast<std::int32_t>(tables_.lights().size());
  const IntN source = IntN::load_aligned(path.sources.data()), aimed_at = IntN::load_aligned(path.targets.data());
  // So many points scatter on a path at most, the last of them to the camera.
  for (path.depth = 0; path.depth < most_points_ && any(alive); ++path.depth) {
    const Vec3<FloatN> from = path.rays.origin;
    Hits hits = intersect(path, path.rays, alive);
    if (none(hits.hit)) return;
    SurfaceInteraction<FloatN> surface = scene_.accelerator().surface(path.rays, hits);
    MediumBoundary boundary;
    if (!tables_.media().empty()) {
      const auto went = [&](const MaskN& lanes, const Rgb<FloatN>& left) {
        path.flux = select(lanes, path.flux * left, path.flux);
      };
      boundary = next_boundary(
          scene_, path.media, path.rays, hits, surface, went, [] { return FloatN(0); },
          [&](Ray<FloatN>& rays, const MaskN& lanes) { return intersect(path, rays, lanes); }, false);
      if (none(hits.hit)) return;
      if (tables_.media().disperses()) [[unlikely]] {
        const Rgb<FloatN> weights = disperse(tables_.media(), boundary, alive & hits.hit, path.pixel, path.sample,
                                             light_path_wavelength_dimension, path.deviation);
        path.flux = path.flux * weights;
        path.share = path.share * weights;
      }
    }
    const SurfaceInteraction<FloatN> plain = surface;  // without relief, which the camera sees at its own footprint
    const auto textures = add_textures(tables_, hits, surface, [] { return FloatN(0); });
    const IntN target = caustics_.target_of(tables_.geometry(), hits, tables_.material(hits));
    alive = alive & hits.hit;
    if (path.depth == 0) {
      // Other targets' paths are aimed at these.
      alive = alive & float_mask<FloatN>(target == aimed_at);
      if (none(alive)) return;
      const MaskN near = alive & path.from_point;
      for (MaskN left = near; any(left);) {
        const std::int32_t number = path.sources[static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(left)))];
        const MaskN here = left & float_mask<FloatN>(source == IntN(number));
        Ray<FloatN> ray;
        ray.origin = surface.p;
        Rgb<FloatN> irradiance;
        tables_.lights()[static_cast<std::size_t>(number)]->sample(ray, {FloatN(0), FloatN(0)}, irradiance);
        const Vec3<FloatN> way = surface.p - from;
        path.flux = select(here, path.flux * irradiance * dot(way, way), path.flux);
        left = left & !here;
      }
      // What came from far away has not met planes beyond all else.
      const MaskN far =
          alive &
          (float_mask<FloatN>(source < IntN(lights)) |
           float_mask<FloatN>(source == IntN(lights + static_cast<std::int32_t>(tables_.emitters().size())))) &
          !path.from_point;
      if (any(far)) {
        const Ray<FloatN> back{from, -path.rays.direction, FloatN(0), infinity<FloatN>()};
        const MaskN hidden =
            tables_.identifies_rays()
                ? occluded_identified(scene_, back, far, ray_ids(path, ~0U >> 2U), Coherence::incoherent)
                : scene_.accelerator().occluded(back, far, Coherence::incoherent);
        alive = alive & !hidden;
      }
    }
    const TexturePoint<FloatN>* const point = textures ? &*textures : nullptr;
    const MaskN focuses = float_mask<FloatN>(target >= IntN(0));
    if (const MaskN scattered = alive & !focuses; any(scattered)) arrive(path, hits, plain, boundary, scattered);
    alive = alive & focuses;
    if (path.depth + 2 > most_points_ || none(alive)) return;
    alive = scatter(path, hits, surface, boundary, point, alive);
  }
}

/// On to the next points. BSDFs are asked the other way round than on paths from the camera: for the direction that
/// light comes from, of which they draw one that it goes to.
MaskN LightPathTracer::scatter(LightPathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                               const MediumBoundary& boundary, const TexturePoint<FloatN>* point,
                               const MaskN& lanes) const {
  const Frame<FloatN> frame = tables_.shading_frame(hits, surface, point);
  const Vec3<FloatN> wi = frame.to_local(surface.wo);
  const auto draw = [&](LightPathPointDraw what) {
    return get_2d(path.pixel, path.sample, light_path_dimension(path.depth, what));
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
  // A smooth base under a coat has a normal of its own, about which both cosines are one.
  if (surface.has_layers)
    f = select(surface.layers.lanes & sample.specular & !through, f * (sample.wi.z / max(wi.z, FloatN(1e-6F))), f);
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
  if (path.depth + 1 >= roulette_depth_) {
    const FloatN survival = min(largest(path.share) * FloatN(2), FloatN(1));
    const FloatN more = FloatN(1) / max(survival, FloatN(1e-12F));
    path.flux = path.flux * more;
    path.share = path.share * more;
    alive = alive & (choice.y < survival);
  }
  boundary.cross(path.media, through & alive, surface.front);
  path.rays.origin = offset_ray_origin(surface, through & alive);
  path.rays.direction = select(alive, wo, path.rays.direction);
  return alive & (largest(path.flux) > FloatN(0));
}

}  // namespace raytrace
