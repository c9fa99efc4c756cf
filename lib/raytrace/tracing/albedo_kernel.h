// The colours of surfaces, without light.
#pragma once

#include <algorithm>

#include "raytrace/integrators/albedo.h"
#include "raytrace/math/kernel.h"
#include "raytrace/tracing/first_surface.h"

namespace raytrace {

template <>
class Kernel<Albedo> {
 public:
  static constexpr bool takes_samples = false;
  static RadianceRange radiance_range(const SceneTables& scene) {
    RadianceRange range = range_of_colors(scene);
    range.largest = std::max(range.largest, scene.largest_albedo());
    return range;
  }

  static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
                            const MaskN& active, const MaskN&, RayCounts&, FirstHits* first) {
    return of_first_surface(scene, background, camera, active, first, [&](const FirstHits& met) {
      return scene.tables().albedo(met.hits, met.textures ? &*met.textures : nullptr);
    });
  }
};

}  // namespace raytrace
