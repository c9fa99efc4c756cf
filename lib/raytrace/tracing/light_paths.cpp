#include "raytrace/tracing/light_paths.h"

#include <bit>
#include <cmath>
#include <optional>
#include <variant>

#include "raytrace/math/frame.h"
#include "raytrace/sampling/pixel_sampler.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/light_layers.h"
#include "raytrace/tracing/media.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

namespace {

std::uint64_t count_of(const MaskN& lanes) { return static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(lanes))); }

/// A path's rays, by what they are among them.
RayIds ray_ids(const LightPathPacket& path, std::uint32_t purpose) {
  return {path.pixel, path.sample, purpose | 0x40000000U};
}

}  // namespace

LightPaths::LightPaths(const TracedScene& scene, Film& film)
    : scene_(scene),
      tables_(scene.tables()),
      caustics_(*tables_.caustics()),
      film_(film),
      catches_shadows_(film.settings().transparent && tables_.geometry().has_shadow_catchers()),
      most_points_(std::get<Path::Parameters>(tables_.integrator()).maxdepth),
      roulette_depth_(std::get<Path::Parameters>(tables_.integrator()).roulettedepth),
      inverse_unit_(std::ldexp(1.0, -film.settings().unit_exponent)) {
  for (const LightLayer* const layer : light_layers(tables_, film))
    layers_.push_back(layer == nullptr ? nullptr : layer->splats.get());
}

void LightPaths::trace(const Pixels& pixels, const UintN& samples, const MaskN& wanted, RenderReport& report) {
  report_ = &report;
  SplatLayer& splats = *film_.splats();
  const auto width = static_cast<std::uint64_t>(film_.settings().extent.full_width);
  LightPathPacket path;
  path.sample = samples;
  std::uint32_t left = bits_of<FloatN>(wanted);
  for (std::uint64_t i = 0; left != 0; ++i) {
    alignas(64) std::array<std::uint32_t, packet_lanes> columns{}, rows{}, lanes{};
    for (std::uint32_t those = left; those != 0; those &= those - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(those));
      const int x = pixels.x[lane], y = pixels.y[lane];
      if (i >= splats.paths_per_sample(x, y)) {
        left &= ~(std::uint32_t{1} << lane);
        continue;
      }
      lanes[lane] = 1;
      path.picture_pixel[lane] = splats.path_pixel(x, y, i);
      columns[lane] = static_cast<std::uint32_t>(path.picture_pixel[lane] % width);
      rows[lane] = static_cast<std::uint32_t>(path.picture_pixel[lane] / width);
    }
    if (left == 0) return;
    path.pixel =
        pixel_hash(UintN::load_aligned(columns.data()), UintN::load_aligned(rows.data()), film_.settings().seed);
    const MaskN here = float_mask<FloatN>(UintN::load_aligned(lanes.data()) != UintN(0u));
    follow(path, start_light_paths(tables_, path) & here);
    splats.add_paths(count_of(here));
  }
}

Hits LightPaths::intersect(const LightPathPacket& path, Ray<FloatN>& rays, const MaskN& lanes) {
  report_->rays.indirect += count_of(lanes);
  rays.far = infinity<FloatN>();
  if (!tables_.identifies_rays()) return scene_.accelerator().intersect(rays, lanes, Coherence::incoherent);
  const RayIdentity identity(tables_, scene_.accelerator(), rays,
                             ray_ids(path, static_cast<std::uint32_t>(path.depth) * 2));
  return scene_.accelerator().intersect(rays, lanes, Coherence::incoherent, nullptr, &identity);
}

void LightPaths::follow(LightPathPacket& path, MaskN alive) {
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
    MaskN shown = alive & !focuses;
    if (catches_shadows_) [[unlikely]]
      shown = shown & !tables_.geometry().shadow_catchers(hits);
    if (any(shown)) connect(path, hits, plain, boundary, shown);
    alive = alive & focuses;
    if (path.depth + 2 > most_points_ || none(alive)) return;
    alive = scatter(path, hits, surface, boundary, point, alive);
  }
}

/// On to the next points. BSDFs are asked the other way round than on paths from the camera: for the direction that
/// light comes from, of which they draw one that it goes to.
MaskN LightPaths::scatter(LightPathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                          const MediumBoundary& boundary, const TexturePoint<FloatN>* point, const MaskN& lanes) const {
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

/// Sends what reaches those points to the camera, where it shows them.
void LightPaths::connect(LightPathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                         const MediumBoundary& boundary, const MaskN& lanes) {
  const Sample2D lens = get_2d(path.pixel, path.sample, light_path_dimension(LightPathDraw::lens));
  std::array<FilmPoint, packet_lanes> points;
  alignas(64) std::array<float, packet_lanes> x{}, y{}, z{}, areas{};
  std::uint32_t shown = 0;
  for (std::uint32_t left = bits_of<FloatN>(lanes); left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const Vec3d p{double{surface.p.x.get(lane)}, double{surface.p.y.get(lane)}, double{surface.p.z.get(lane)}};
    const std::optional<FilmPoint> point = tables_.project(p, lens, lane);
    if (!point) continue;
    points[lane] = *point;
    const Vec3d way = point->from - p;
    x[lane] = static_cast<float>(way.x);
    y[lane] = static_cast<float>(way.y);
    z[lane] = static_cast<float>(way.z);
    areas[lane] = static_cast<float>(point->area);
    shown |= std::uint32_t{1} << lane;
  }
  if (shown == 0) return;
  const Vec3<FloatN> way{FloatN::load_aligned(x.data()), FloatN::load_aligned(y.data()),
                         FloatN::load_aligned(z.data())};
  SurfaceInteraction<FloatN> seen = surface;
  seen.wo = unit_vector(way);
  const FloatN distance = length(way), cosine = dot(seen.wo, seen.ng), true_wi = dot(surface.wo, surface.ng);
  const MaskN facing = lanes & (FloatN::load_aligned(areas.data()) > FloatN(0)) & (cosine > FloatN(0));
  if (none(facing)) return;
  // As a camera ray to there has it.
  const auto textures = add_textures(tables_, hits, seen, [&] { return tables_.ray_cone().half_width(distance); });
  const TexturePoint<FloatN>* const point = textures ? &*textures : nullptr;
  const Frame<FloatN> frame = tables_.shading_frame(hits, seen, point);
  const Vec3<FloatN> wo = frame.to_local(seen.wo), wi = frame.to_local(surface.wo);
  const MaskN lit = facing & (wi.z > FloatN(0));
  if (none(lit)) return;
  const FloatN any_number(0.5F);
  const BsdfValue bsdf =
      tables_.scatter(hits, seen, frame, boundary.media, wo, lit, wi, any_number, any_number, any_number, point)
          .towards;
  FloatN weight = FloatN::load_aligned(areas.data()) * cosine * (wi.z / max(true_wi, FloatN(1e-6F)));
  if (seen.has_relief) weight = weight * relief_shadow(seen, surface.wo);
  Rgb<FloatN> radiance = path.flux * bsdf.f * weight;
  if (!tables_.media().empty()) radiance = radiance * tables_.media().transmittance(boundary.current, distance);
  MaskN arrives = lit & (largest(radiance) > FloatN(0));
  if (none(arrives)) return;
  Ray<FloatN> ray;
  ray.origin = offset_ray_origin(seen);
  ray.direction = way + (surface.p - ray.origin);
  ray.near = FloatN(0);
  ray.far = FloatN(1);
  report_->rays.shadow += count_of(arrives);
  const MaskN hidden =
      tables_.identifies_rays()
          ? occluded_identified(scene_, ray, arrives, ray_ids(path, static_cast<std::uint32_t>(path.depth) * 2 + 1),
                                Coherence::incoherent)
          : scene_.accelerator().occluded(ray, arrives, Coherence::incoherent);
  for (std::uint32_t left = bits_of<FloatN>(arrives & !hidden); left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    splat(path, lane, points[lane], radiance);
  }
}

void LightPaths::splat(const LightPathPacket& path, std::size_t lane, const FilmPoint& point,
                       const Rgb<FloatN>& radiance) {
  const PictureExtent& extent = film_.settings().extent;
  const FilterTable& filter = tables_.pixel_filter();
  const double pixels = static_cast<double>(extent.full_width) * static_cast<double>(extent.full_height);
  const Rgb<float> brought(radiance.red.get(lane), radiance.green.get(lane), radiance.blue.get(lane));
  // From the picture's upper left corner.
  const double x = point.x + extent.full_width / 2.0, y = extent.full_height / 2.0 - point.y, reach = filter.reach();
  const Region& region = film_.region();
  if (!(x > region.x0 - reach && x < region.x1 + reach && y > region.y0 - reach && y < region.y1 + reach)) return;
  const auto first = [&](double at) { return static_cast<int>(std::ceil(at - reach - 0.5)); };
  const auto last = [&](double at) { return static_cast<int>(std::floor(at + reach - 0.5)); };
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const bool moves = filter.moves_samples();
  for (int to_y = moves ? first(y) : row; to_y <= (moves ? last(y) : row); ++to_y)
    for (int to_x = moves ? first(x) : column; to_x <= (moves ? last(x) : column); ++to_x) {
      if (to_x < region.x0 || to_x >= region.x1 || to_y < region.y0 || to_y >= region.y1) continue;
      const double share =
          moves ? filter.density(x - to_x - 0.5) * filter.density(y - to_y - 0.5) / pixels : 1 / pixels;
      if (share == 0) continue;
      RadianceSum units;
      std::size_t channel = 0;
      bool fits = true;
      for (const float value : {brought.red, brought.green, brought.blue}) {
        const double term = std::nearbyint(double{value} * share * inverse_unit_);
        fits = fits && std::abs(term) <= largest_units;
        units[channel++] = fits ? static_cast<Int128>(term) : 0;
      }
      if (fits) {
        film_.splats()->add(to_x, to_y, units);
        if (RadianceLayer* const layer = layers_[static_cast<std::size_t>(path.groups[lane])])
          layer->add(to_x, to_y, units);
      } else {
        const auto width = static_cast<std::uint64_t>(extent.full_width);
        report_->invalid_samples.add({static_cast<int>(path.picture_pixel[lane] % width),
                                      static_cast<int>(path.picture_pixel[lane] / width), path.sample.get(lane)});
        return;
      }
    }
}

}  // namespace raytrace
