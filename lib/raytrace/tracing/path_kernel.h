// Path tracing.
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <variant>

#include "raytrace/integrators/path.h"
#include "raytrace/math/frame.h"
#include "raytrace/math/kernel.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/camera_hits.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/ray_result.h"

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
    Rgb<FloatN> direct = black, indirect = black, throughput(Rgb<float>(1, 1, 1));
    FloatN eta2(1);  // of the media that the path is in and was in at its start, squared
    Ray<FloatN> rays = camera.rays;
    FloatN distance = camera.skipped;  // of all rays of the path
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
      // The numbers of keys: one for each ray of a point, the next point's own first.
      const auto rays_a_point = static_cast<std::uint32_t>(tables.lights().size()) + 1;
      const auto first_key = static_cast<std::uint32_t>(depth) * rays_a_point;
      const ShadowNumbers numbers{camera.pixel, camera.sample, first_key + 1};
      const Coherence coherence = depth == 0 ? Coherence::coherent : Coherence::incoherent;
      const Rgb<FloatN> light =
          throughput * direct_light(scene, hits, surface, point, coherence, counted, counts, numbers);
      Rgb<FloatN>& sum = depth == 0 ? direct : indirect;
      sum = sum + select(hits.hit, light, black);
      if (depth + 1 == settings.maxdepth) break;

      const Sample2D direction = get_2d(camera.pixel, camera.sample, path_dimension(depth, PathDraw::direction));
      const Sample2D choices = get_2d(camera.pixel, camera.sample, path_dimension(depth, PathDraw::lobe_and_roulette));
      const Frame<FloatN> frame(surface.ns);
      const BsdfSample<FloatN> sample =
          tables.sample(hits, surface.front, frame.to_local(surface.wo), choices.x, direction.x, direction.y, point);
      rays.direction = frame.to_world(sample.wi);
      // On the true surface the direction is on the same side as on the shaded one.
      const MaskN through = sample.wi.z < FloatN(0);
      MaskN alive = hits.hit & (sample.pdf > FloatN(0)) & (dot(rays.direction, surface.ng) * sample.wi.z > FloatN(0));
      FloatN weight = abs(sample.wi.z) / sample.pdf;
      if (surface.has_relief) weight = select(through, weight, weight * relief_shadow(surface, rays.direction));
      eta2 = eta2 * sample.eta2;
      throughput = select(alive, throughput * sample.f * weight, black);
      if (depth + 1 >= settings.roulettedepth) {
        const FloatN survival = min(largest(throughput) * eta2, FloatN(1));
        const MaskN survives = choices.y < survival;
        throughput = throughput * (FloatN(1) / max(survival, FloatN(1e-12F)));
        alive = alive & survives;
      }
      alive = alive & (largest(throughput) > FloatN(0));
      if (none(alive)) break;
      rays.origin = offset_ray_origin(surface, through & alive);
      rays.near = FloatN(0);
      rays.far = infinity<FloatN>();
      counts.indirect += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(alive & counted)));
      if (tables.has_cutouts()) {
        const CutoutQuery query{tables, scene.accelerator(), rays,
                                ray_keys(camera.pixel, camera.sample, first_key + rays_a_point)};
        hits = scene.accelerator().intersect(rays, alive, Coherence::incoherent, nullptr, &query);
      } else {
        hits = scene.accelerator().intersect(rays, alive, Coherence::incoherent);
      }
      const MaskN escaped = alive & !hits.hit;
      if (any(escaped)) {
        const Rgb<FloatN> sky = tables.environment() != nullptr
                                    ? tables.environment()->radiance(rays.direction)
                                    : Rgb<FloatN>(Rgb<float>(tables.viewplane().background));
        indirect = indirect + select(escaped, throughput * sky, black);
      }
    }
    if (settings.clampindirect > 0) {
      const Rgb<FloatN> most(Rgb<float>(1, 1, 1) * static_cast<float>(settings.clampindirect));
      indirect = {min(indirect.red, most.red), min(indirect.green, most.green), min(indirect.blue, most.blue)};
    }
    return {select(hit, direct + indirect, Rgb<FloatN>(background)), hit};
  }

 private:
  /// By magnitude.
  static FloatN largest(const Rgb<FloatN>& color) {
    return max(max(abs(color.red), abs(color.green)), abs(color.blue));
  }
};

}  // namespace raytrace
