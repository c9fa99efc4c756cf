// Shading normals as colours.
#pragma once

#include "raytrace/integrators/normals.h"
#include "raytrace/math/kernel.h"
#include "raytrace/tracing/first_surface.h"

namespace raytrace {

template <>
class Kernel<Normals> {
 public:
  static constexpr bool takes_samples = false;
  static RadianceRange radiance_range(const SceneTables& scene) { return range_of_colors(scene); }

  static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                            const MaskN& active, const MaskN&, RayCounts&, FirstHits* first) {
    return of_first_surface(scene, background, camera, active, first, [](const FirstHits& met) {
      const auto color = [](const FloatN& component) {
        return min(max(component * FloatN(0.5F) + FloatN(0.5F), FloatN(0)), FloatN(1));
      };
      const Vec3<FloatN> normal = met.surface.base_normal();
      return Rgb<FloatN>{color(normal.x), color(normal.y), color(normal.z)};
    });
  }
};

}  // namespace raytrace
