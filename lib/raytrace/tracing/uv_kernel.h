// Texture coordinates as colours.
#pragma once

#include "raytrace/integrators/uv.h"
#include "raytrace/math/kernel.h"
#include "raytrace/tracing/first_surface.h"

namespace raytrace {

template <>
class Kernel<Uv> {
 public:
  static constexpr bool takes_samples = false;
  static RadianceRange radiance_range(const SceneTables& scene) { return range_of_colors(scene); }

  static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                            const MaskN& active, const MaskN&, RayCounts&, FirstHits* first) {
    return of_first_surface(scene, background, camera, active, first, [&](const FirstHits& met) {
      // Most materials want no coordinates.
      const Vec2<FloatN> uv =
          met.textures ? met.textures->uv : texture_point(scene.tables(), camera, met.hits, met.surface).uv;
      return Rgb<FloatN>{uv.x - floor(uv.x), uv.y - floor(uv.y), FloatN(0)};
    });
  }
};

}  // namespace raytrace
