#include "raytrace/tracing/light_paths.h"

#include <cmath>
#include <optional>
#include <variant>

#include "raytrace/math/frame.h"
#include "raytrace/math/lanes.h"
#include "raytrace/sampling/footprint.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/pixel_sampler.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/fog.h"
#include "raytrace/tracing/identified_rays.h"
#include "raytrace/tracing/light_layers.h"
#include "raytrace/tracing/light_parts.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

LightPaths::LightPaths(const TracedScene& scene, Film& film, StageClock& clock)
    : LightPathTracer(scene, std::get<Path::Parameters>(scene.tables().integrator()).maxdepth, clock),
      film_(film),
      catches_shadows_(film.settings().transparent && tables_.geometry().has_shadow_catchers()),
      inverse_unit_(std::ldexp(1.0, -film.settings().unit_exponent)) {
  for (const LightLayer* const layer : light_layers(tables_, film))
    layers_.push_back(layer == nullptr ? nullptr : layer->splats.get());
  const PassLayers passes = pass_layers(film);
  const auto splats_of = [&](LightPass pass) {
    const LightLayer* const layer = passes[static_cast<std::size_t>(pass)];
    return layer == nullptr ? nullptr : layer->splats.get();
  };
  diffuse_ = splats_of(LightPass::diffuse_indirect);
  specular_ = splats_of(LightPass::specular_indirect);
}

void LightPaths::begin(const Pixels& pixels, const UintN& samples, const MaskN& wanted, RenderReport& report) {
  report_ = &report;
  SplatLayer& splats = *film_.splats();
  const auto width = static_cast<std::uint64_t>(film_.settings().extent.full_width);
  std::uint32_t left = bits_of<FloatN>(wanted);
  for (std::uint64_t i = 0; left != 0; ++i) {
    alignas(64) std::array<std::int32_t, packet_lanes> columns{}, rows{}, lanes{};
    for (const std::size_t lane : SetLanes(left)) {
      const int x = pixels.x[lane], y = pixels.y[lane];
      if (i >= splats.paths_per_sample(x, y)) {
        left &= ~(std::uint32_t{1} << lane);
        continue;
      }
      lanes[lane] = 1;
      const std::uint64_t pixel = splats.path_pixel(x, y, i);
      columns[lane] = static_cast<std::int32_t>(pixel % width);
      rows[lane] = static_cast<std::int32_t>(pixel / width);
    }
    if (left == 0) return;
    const IntN column = IntN::load_aligned(columns.data()), row = IntN::load_aligned(rows.data());
    const MaskN here = float_mask<FloatN>(IntN::load_aligned(lanes.data()) != IntN(0));
    LightPathTracer::begin(pixel_hash(same_bits<UintN>(column), same_bits<UintN>(row), film_.settings().seed), samples,
                           column, row, here, report.rays);
    splats.add_paths(count_lanes(here));
  }
}

void LightPaths::finish(RenderReport& report) {
  report_ = &report;
  follow(report.rays);
}

void LightPaths::arrive(const LightPathPoint& at, const MaskN& scattered) {
  const auto& [path, depth, media, hits, surface, boundary] = at;
  MaskN lanes = scattered;
  if (catches_shadows_) [[unlikely]] {
    lanes = lanes & !tables_.geometry().shadow_catchers(hits);
    if (none(lanes)) return;
  }
  const bool has_invisible = tables_.geometry().has_invisible();
  if (has_invisible) [[unlikely]] {
    lanes = lanes & !tables_.geometry().invisible(hits);
    if (none(lanes)) return;
  }
  const Sample2D lens = get_2d(path.pixel, path.sample, light_path_dimension(LightPathDraw::lens));
  std::array<FilmPoint, packet_lanes> points;
  alignas(64) std::array<float, packet_lanes> x{}, y{}, z{}, areas{}, shares{};
  std::uint32_t shown = 0;
  for (const std::size_t lane : SetLanes(lanes)) {
    const Vec3d p(in_lane(surface.p, lane));
    const std::optional<FilmPoint> point = tables_.project(p, lens, lane);
    if (!point) continue;
    points[lane] = *point;
    const Vec3d way = point->from - p;
    x[lane] = static_cast<float>(way.x);
    y[lane] = static_cast<float>(way.y);
    z[lane] = static_cast<float>(way.z);
    areas[lane] = static_cast<float>(point->area);
    shares[lane] = static_cast<float>(point->seen);
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
  // What gloss reflects of lamps and skies, paths from the camera find; of lights without size they do not.
  Rgb<FloatN> f = bsdf.f;
  if (const MaskN found = lit & float_mask<FloatN>(path.source >= IntN(static_cast<int>(tables_.lights().size())));
      any(found)) {
    const Rgb<FloatN> gloss = tables_.gloss(hits, seen, frame, boundary.media, wo, wi, Gloss::sharp, point);
    f = select(found, saturating_difference(f, gloss), f);
  }
  Rgb<FloatN> gloss(Rgb<float>(0, 0, 0));  // the share of it
  if (diffuse_ != nullptr || specular_ != nullptr) [[unlikely]] {
    const Rgb<FloatN> of_all = tables_.gloss(hits, seen, frame, boundary.media, wo, wi, Gloss::any, point);
    gloss = share_of(saturating_difference(of_all, bsdf.f - f), f);
  }
  Rgb<FloatN> radiance = path.flux * f * weight;
  const RayIds ids = ray_ids(path, static_cast<std::uint32_t>(depth) * 2 + 1);
  // The camera sees through other media than those that the light came through where some are not visible to it.
  const bool has_fog = tables_.media().has_fog(), sees_others = tables_.has_invisible_media();
  MediumStack seen_media = media;
  if (sees_others) seen_media.keep_common(scene_.media_for_camera(offset_ray_origin(seen), lit, ids));
  const IntN current = sees_others ? seen_media.current(tables_.media()) : boundary.current;
  const FloatN share = FloatN::load_aligned(shares.data());
  if (!tables_.media().empty() && !has_fog)
    radiance = radiance * tables_.media().transmittance(current, distance * share);
  MaskN arrives = lit & (largest(radiance) > FloatN(0));
  if (none(arrives)) return;
  Ray<FloatN> ray;
  ray.origin = offset_ray_origin(seen);
  ray.direction = way + (surface.p - ray.origin);
  ray.near = FloatN(0);
  ray.far = share;
  report_->rays.shadow += count_lanes(arrives);
  const MaskN hidden = occluded(scene_, ray, arrives, ids, Coherence::incoherent, has_invisible);
  arrives = arrives & !hidden;
  if (has_fog && any(arrives)) [[unlikely]]
    radiance = radiance * light_through(scene_, ray, arrives, ids, {seen_media, current}, MaskN(true));
  for (const std::size_t lane : SetLanes(arrives)) splat(at, lane, points[lane], radiance, gloss);
}

void LightPaths::splat(const LightPathPoint& at, std::size_t lane, const FilmPoint& point, const Rgb<FloatN>& radiance,
                       const Rgb<FloatN>& gloss) {
  const LightPathPacket& path = at.path;
  const PictureExtent& extent = film_.settings().extent;
  const FilterTable& filter = tables_.pixel_filter();
  const double pixels = static_cast<double>(extent.full_width) * static_cast<double>(extent.full_height);
  const Rgb<float> brought = in_lane(radiance, lane), of_gloss = in_lane(gloss, lane);
  // From the picture's upper left corner.
  const double x = point.x + extent.full_width / 2.0, y = extent.full_height / 2.0 - point.y, reach = filter.reach();
  const Region& region = film_.region();
  if (!(x > region.x0 - reach && x < region.x1 + reach && y > region.y0 - reach && y < region.y1 + reach)) return;
  const bool single = film_.settings().single_splats;
  const auto chance = [&](std::uint32_t axis) -> std::optional<double> {
    constexpr std::uint32_t purpose = 0x73706c61;
    if (!single) return std::nullopt;
    const auto depth = static_cast<std::uint32_t>(at.depth);
    return hash<std::uint32_t>(path.pixel.get(lane), path.sample.get(lane), depth, purpose + axis) * 0x1p-32;
  };
  const Footprint columns(filter, x, chance(0)), rows(filter, y, chance(1));
  for (int to_y = rows.first(); to_y <= rows.last(); ++to_y)
    for (int to_x = columns.first(); to_x <= columns.last(); ++to_x) {
      if (to_x < region.x0 || to_x >= region.x1 || to_y < region.y0 || to_y >= region.y1) continue;
      const double share = columns.share(to_x) * rows.share(to_y) / pixels;
      if (share == 0) continue;
      RadianceSum units, gloss_units, diffuse_units;
      std::size_t channel = 0;
      bool fits = true;
      const float gloss_shares[] = {of_gloss.red, of_gloss.green, of_gloss.blue};
      for (const float value : {brought.red, brought.green, brought.blue}) {
        const double term = std::nearbyint(double{value} * share * inverse_unit_);
        fits = fits && std::abs(term) <= largest_units;
        units[channel] = fits ? static_cast<Int128>(term) : 0;
        gloss_units[channel] = fits ? static_cast<Int128>(std::nearbyint(term * gloss_shares[channel])) : 0;
        diffuse_units[channel] = units[channel] - gloss_units[channel];
        ++channel;
      }
      if (fits) {
        film_.splats()->add(to_x, to_y, units);
        if (RadianceLayer* const layer = layers_[static_cast<std::size_t>(path.group.get(lane))])
          layer->add(to_x, to_y, units);
        if (diffuse_ != nullptr) diffuse_->add(to_x, to_y, diffuse_units);
        if (specular_ != nullptr) specular_->add(to_x, to_y, gloss_units);
      } else {
        report_->invalid_samples.add({path.column.get(lane), path.row.get(lane), path.sample.get(lane)});
        return;
      }
    }
}

}  // namespace raytrace
