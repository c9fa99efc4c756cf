// Ambient occlusion.
#pragma once

#include <variant>

#include "raytrace/integrators/ambient_occlusion.h"
#include "raytrace/math/frame.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/turns.h"
#include "raytrace/tracing/first_surface.h"
#include "raytrace/tracing/identified_rays.h"

namespace raytrace {

template <>
class Kernel<AmbientOcclusion> {
 public:
  static constexpr bool takes_samples = true;
  static RadianceRange radiance_range(const SceneTables& scene) { return range_of_colors(scene); }

  static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                            const MaskN& active, const MaskN& counted, RayCounts& counts, FirstHits* first) {
    return of_first_surface(scene, background, camera, active, first, [&](const FirstHits& met) {
      const SurfaceInteraction<FloatN>& surface = met.surface;
      const auto& settings = std::get<AmbientOcclusion::Parameters>(scene.tables().integrator());
      const Sample2D u = get_2d(camera.pixel, camera.sample, path_dimension(0, PathDraw::direction));
      const auto around = sin_cos_of_turns(u.y);
      const FloatN sine = sqrt(u.x);  // the density is the cosine / pi
      Ray<FloatN> rays;
      rays.origin = offset_ray_origin(surface);
      rays.direction = Frame<FloatN>(surface.base_normal())
                           .to_world({sine * around.cosine, sine * around.sine, sqrt(FloatN(1) - u.x)});
      rays.near = FloatN(0);
      rays.far = settings.distance > 0 ? FloatN(static_cast<float>(settings.distance)) : infinity<FloatN>();
      // Below the true surface there is the thing itself.
      const MaskN upwards = met.hits.hit & (dot(rays.direction, surface.true_normal()) > FloatN(0));
      counts.shadow += count_lanes(upwards & counted);
      const MaskN hidden = occluded(scene, rays, upwards, {camera.pixel, camera.sample, 1}, Coherence::incoherent);
      const FloatN white = select(upwards & !hidden, FloatN(1), FloatN(0));
      return Rgb<FloatN>{white, white, white};
    });
  }
};

}  // namespace raytrace
