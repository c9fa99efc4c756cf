#include "raytrace/integrators/raycast.h"

#include <array>
#include <bit>

#include "raytrace/integrators/ray_origin.h"

namespace raytrace {

namespace {

/// Lights are gathered in runs of this many before the materials see them, so that each material reads its parameters
/// once a run. Runs are counted with the lights that no lane sees: how a lane's radiance is summed must not depend on
/// the others.
constexpr std::size_t lights_per_run = 16;

}  // namespace

RayResult Raycast::radiance(const TracedScene& scene, const Rgb<float>& background, Ray<FloatN>& rays,
                            const MaskN& active, const MaskN& counted, RayCounts& counts, HitSurface* met) {
  const Hits hits = scene.accelerator().intersect(rays, active, Coherence::coherent, scene.camera_buffer());
  if (met != nullptr) met->hits = hits;
  if (none(hits.hit)) return {Rgb<FloatN>(background), hits.hit};

  const SurfacePoint<FloatN> point = scene.accelerator().surface(rays, hits);
  if (met != nullptr) met->point = point;

  std::array<ArrivingLight, lights_per_run> arriving;
  std::size_t count = 0;
  Rgb<FloatN> radiance{Rgb<float>(0, 0, 0)};
  Rgb<float> ambient = scene.ambient_radiance();
  const auto shade_run = [&] {
    radiance += scene.shade(hits, rays.direction, point.normal, ambient, {arriving.data(), count});
    ambient = Rgb<float>(0, 0, 0);
    count = 0;
  };
  Ray<FloatN> shadow_rays;
  shadow_rays.origin = offset_ray_origin(point);
  shadow_rays.near = FloatN(0);
  for (std::size_t number = 0; number < scene.lights().size(); ++number) {
    // The first run has the ambient light, whoever sees the others.
    if (number > 0 && number % lights_per_run == 0 && (count > 0 || number == lights_per_run)) shade_run();
    const LightSource& light = *scene.lights()[number];
    const bool shadows = light.shadows();
    ArrivingLight& arriving_here = arriving[count];  // in its place at once: it is large
    light.sample(shadow_rays, arriving_here.radiance);
    // Of any length: the shadow rays need not wait for a square root and a quotient.
    MaskN lit = hits.hit & (dot(point.normal, shadow_rays.direction) > FloatN(0));
    if (shadows && any(lit)) {
      counts.shadow += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(lit & counted)));
      const MaskN occluded =
          scene.accelerator().occluded(shadow_rays, lit, Coherence::coherent, scene.light_buffer(number));
      lit = lit & !occluded;
    }
    if (none(lit)) continue;
    arriving_here.wi = normalize(shadow_rays.direction);
    arriving_here.cosine = select(lit, max(dot(point.normal, arriving_here.wi), FloatN(0)), FloatN(0));
    ++count;
  }
  if (count > 0 || scene.lights().size() <= lights_per_run) shade_run();
  return {select(hits.hit, radiance, Rgb<FloatN>(background)), hits.hit};
}

}  // namespace raytrace
