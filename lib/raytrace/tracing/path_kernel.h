// Path tracing.
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <variant>

#include "raytrace/integrators/path.h"
#include "raytrace/math/kernel.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/camera_hits.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/ray_result.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

template <>
class Kernel<Path> {
 public:
  static constexpr bool takes_samples = true;

  static RadianceRange radiance_range(const SceneTables& scene) {
    RadianceRange range = scene.radiance_range();
    // A room may send on what it got many times; beyond that, sums have more digits at hand.
    range.usual *= 4;
    return range;
  }

  [[gnu::noinline]] static RayResult radiance(const TracedScene& scene, const Rgb<float>& background,
                                              CameraRays& camera, const MaskN& active, const MaskN& counted,
                                              RayCounts& counts, FirstHits* first) {
    const SceneTables& tables = scene.tables();
    const Path::Parameters& settings = std::get<Path::Parameters>(tables.integrator());
    Hits hits = intersect_camera_rays(scene, camera, active);
    if (first != nullptr) {
      first->hits = hits;
      first->textures.reset();
    }
    const MaskN hit = hits.hit;
    const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
    // direct: what was scattered once or never.
    Rgb<FloatN> direct = black, indirect = black, throughput(Rgb<float>(1, 1, 1));
    FloatN eta2(1);  // of the media that the path is in and was in at its start, squared
    Ray<FloatN> rays = camera.rays;
    FloatN distance = camera.skipped;  // of all rays of the path
    // Of the last direction: its density, infinite where light cannot be drawn for it, and where it starts.
    FloatN pdf = infinity<FloatN>();
    Vec3<FloatN> from, from_normal;
    const auto lights = static_cast<std::uint32_t>(tables.lights().size());
    const float environment_share = environment_share_of(tables);
    const bool has_drawn_light = tables.environment() != nullptr || !tables.emitters().empty();
    for (int depth = 0; any(hits.hit); ++depth) {
      SurfaceInteraction<FloatN> surface = scene.accelerator().surface(rays, hits);
      distance = distance + rays.far;
      const auto textures = add_textures(tables, hits, surface, [&] { return tables.ray_cone().half_width(distance); });
      const TexturePoint<FloatN>* const point = textures ? &*textures : nullptr;
      if (depth == 0 && first != nullptr) {
        first->surface = surface;
        first->textures = textures;
      }
      if (tables.has_transmission()) {
        const Rgb<FloatN> left = tables.transmittance(hits, rays.far, point);
        throughput = select(hits.hit & !surface.front, throughput * left, throughput);
      }
      if (tables.has_emission()) {
        Rgb<FloatN> emitted = tables.emitted(hits, surface, point);
        if (depth > 0 && !tables.emitters().empty()) {
          const MaskN shines = hits.hit & (pdf < infinity<FloatN>()) & (largest(emitted) > FloatN(0));
          if (any(shines)) {
            const FloatN other =
                tables.emitters().pdf(from, from_normal, hits, shines, surface) * FloatN(1 - environment_share);
            emitted = select(shines, emitted * power_heuristic(pdf, other), emitted);
          }
        }
        Rgb<FloatN>& sum = depth <= 1 ? direct : indirect;
        sum = sum + select(hits.hit, throughput * emitted, black);
      }
      if (depth == settings.maxdepth) break;

      // The numbers of keys: one for each ray of a point, the next point's own first.
      const std::uint32_t first_key = static_cast<std::uint32_t>(depth) * (lights + 2);
      const auto key = [&](std::uint32_t ray) { return ray_keys(camera.pixel, camera.sample, first_key + ray); };
      const auto draw = [&](PathDraw what) { return get_2d(camera.pixel, camera.sample, path_dimension(depth, what)); };
      const Coherence coherence = depth == 0 ? Coherence::coherent : Coherence::incoherent;
      const Frame<FloatN> frame = tables.shading_frame(hits, surface, point);
      const PathVertex vertex{hits, surface, point, frame, frame.to_local(surface.wo), distance};
      Rgb<FloatN> light = direct_light(scene, hits, surface, point, coherence, counted, counts,
                                       ShadowNumbers{camera.pixel, camera.sample, first_key + 1});
      if (has_drawn_light)
        light += sampled_light(scene, vertex, draw(PathDraw::light), draw(PathDraw::light_point), coherence,
                               key(lights + 1), counted, counts);
      Rgb<FloatN>& sum = depth == 0 ? direct : indirect;
      sum = sum + select(hits.hit, throughput * light, black);
      // The last direction is for what shines alone.
      const bool is_last = depth + 1 == settings.maxdepth;
      if (is_last && !tables.has_emission() && tables.environment() == nullptr) break;

      const Sample2D direction = draw(PathDraw::direction), choices = draw(PathDraw::lobe_and_roulette);
      const BsdfSample<FloatN> sample =
          tables.sample(hits, surface.front, vertex.wo, choices.x, direction.x, direction.y, point);
      rays.direction = frame.to_world(sample.wi);
      const MaskN through = sample.wi.z < FloatN(0);
      // On the true surface the direction is on the same side as on the shaded one.
      MaskN alive = hits.hit & (sample.pdf > FloatN(0)) & (dot(rays.direction, surface.ng) * sample.wi.z > FloatN(0));
      FloatN weight = abs(sample.wi.z) / sample.pdf;
      if (surface.has_relief) weight = select(through, weight, weight * relief_shadow(surface, rays.direction));
      throughput = select(alive, throughput * sample.f * weight, black);
      eta2 = eta2 * sample.eta2;
      if (depth + 1 >= settings.roulettedepth) {
        // Twice as many as carry it: what ends has cost little, and what goes on need not be much brighter.
        const FloatN survival = min(largest(throughput) * eta2 * FloatN(2), FloatN(1));
        const MaskN survives = choices.y < survival;
        throughput = throughput * (FloatN(1) / max(survival, FloatN(1e-12F)));
        alive = alive & survives;
      }
      alive = alive & (largest(throughput) > FloatN(0));
      if (none(alive)) break;
      pdf = select(sample.specular | through, infinity<FloatN>(), sample.pdf);
      from = surface.p;
      from_normal = surface.ns;
      rays.origin = offset_ray_origin(surface, through & alive);
      rays.near = FloatN(0);
      rays.far = infinity<FloatN>();
      counts.indirect += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(alive & counted)));
      if (tables.has_cutouts()) {
        const CutoutQuery query{tables, scene.accelerator(), rays, key(lights + 2)};
        hits = scene.accelerator().intersect(rays, alive, Coherence::incoherent, nullptr, &query);
      } else {
        hits = scene.accelerator().intersect(rays, alive, Coherence::incoherent);
      }
      const MaskN escaped = alive & !hits.hit;
      if (any(escaped)) {
        Rgb<FloatN> sky(Rgb<float>(tables.viewplane().background));
        if (const Environment* const environment = tables.environment(); environment != nullptr) {
          const FloatN other = environment->pdf(rays.direction) * FloatN(environment_share);
          sky = environment->radiance(rays.direction) * power_heuristic(pdf, other);
        } else if (is_last) {
          continue;
        }
        sum = sum + select(escaped, throughput * sky, black);
      }
    }
    if (settings.clampindirect > 0) {
      const Rgb<FloatN> most(Rgb<float>(1, 1, 1) * static_cast<float>(settings.clampindirect));
      indirect = {min(indirect.red, most.red), min(indirect.green, most.green), min(indirect.blue, most.blue)};
    }
    return {select(hit, direct + indirect, Rgb<FloatN>(background)), hit};
  }
};

}  // namespace raytrace
