// Follows light paths from where they start (tracing/light_path_start.h) by way of mirrors, metals and clear glass.
#pragma once

#include <bit>
#include <cstdint>

#include "raytrace/accel/traced_scene.h"
#include "raytrace/tracing/light_path_start.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

class LightPathTracer {
 public:
  LightPathTracer(const LightPathTracer&) = delete;
  LightPathTracer& operator=(const LightPathTracer&) = delete;

 protected:
  /// The scene must have caustics. Paths have at most so many points; the last does not focus light.
  LightPathTracer(const TracedScene& scene, int most_points);
  ~LightPathTracer() = default;

  /// Follows those lanes' paths, from their starts to where they end, and counts their rays.
  void follow(LightPathPacket& path, MaskN alive, RayCounts& rays);

  /// Called where paths come to points that do not focus light, in those lanes, by one or more that do. path.flux: what
  /// arrives there from surface.wo, from path.depth points before. surface: without relief.
  virtual void arrive(const LightPathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                      const MediumBoundary& boundary, const MaskN& lanes) = 0;

  /// A path's rays, by what they are among them.
  static RayIds ray_ids(const LightPathPacket& path, std::uint32_t purpose) {
    return {path.pixel, path.sample, purpose | 0x40000000U};
  }

  const TracedScene& scene_;
  const SceneTables& tables_;
  const CausticTable& caustics_;

 private:
  Hits intersect(LightPathPacket& path, Ray<FloatN>& rays, const MaskN& lanes);
  MaskN scatter(LightPathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                const MediumBoundary& boundary, const TexturePoint<FloatN>* point, const MaskN& lanes) const;

  int most_points_, roulette_depth_;
  RayCounts* rays_ = nullptr;  ///< while follow() runs
};

}  // namespace raytrace
