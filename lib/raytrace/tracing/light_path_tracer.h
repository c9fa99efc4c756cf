// Follows light paths from where they start (tracing/light_path_start.h) by way of mirrors, metals and clear glass.
//
// As with paths from the camera (tracing/path_batch.h), many are followed together, point by point, in packets that
// are put together anew at each: most end soon, and would leave lanes empty.
#pragma once

#include <cstdint>
#include <vector>

#include "raytrace/accel/traced_scene.h"
#include "raytrace/tracing/light_path_start.h"
#include "raytrace/tracing/path_chunk.h"
#include "raytrace/tracing/render_report.h"
#include "raytrace/tracing/stage_times.h"

namespace raytrace {

/// Where light paths have come to.
struct LightPathPoint {
  const LightPathPacket& path;
  int depth;                 ///< the points before
  const MediumStack& media;  ///< that the paths came through
  const Hits& hits;
  const SurfaceInteraction<FloatN>& surface;  ///< without relief
  const MediumBoundary& boundary;
};

class LightPathTracer {
 public:
  LightPathTracer(const LightPathTracer&) = delete;
  LightPathTracer& operator=(const LightPathTracer&) = delete;

 protected:
  /// The scene must have caustics. Paths have at most so many points; the last does not focus light. clock: of the
  /// thread. Throws std::bad_alloc.
  LightPathTracer(const TracedScene& scene, int most_points, StageClock& clock);
  ~LightPathTracer() = default;

  /// Begins a path in each of those lanes, which draws that pixel's and sample's numbers and belongs to that pixel, and
  /// counts its rays. As soon as enough paths are under way, it follows them.
  void begin(const UintN& pixel, const UintN& sample, const IntN& column, const IntN& row, const MaskN& lanes,
             RayCounts& rays);
  /// Follows all paths to their ends.
  void follow(RayCounts& rays);

  /// Called where paths come to points that do not focus light, in those lanes, by one or more that do. path.flux: what
  /// arrives there from surface.wo.
  virtual void arrive(const LightPathPoint& point, const MaskN& lanes) = 0;

  /// A path's rays, by what they are among them.
  static RayIds ray_ids(const LightPathPacket& path, std::uint32_t purpose) {
    return {path.pixel, path.sample, purpose | 0x40000000U};
  }

  const TracedScene& scene_;
  const SceneTables& tables_;
  const CausticTable& caustics_;

 private:
  using Chunk = PathChunk<LightPathPacket>;
  static constexpr std::size_t most_paths = 1024;

  Hits intersect(LightPathPacket& path, MediumStack& media, int depth, Ray<FloatN>& rays, const MaskN& lanes,
                 RayCounts& counts) const;
  /// From the points that these paths have come to, in those lanes, to the next ones.
  void extend(LightPathPacket& path, MaskN alive, int depth, RayCounts& counts);
  /// What is left of paths at their first points.
  MaskN arrive_first(LightPathPacket& path, const Vec3<FloatN>& from, const SurfaceInteraction<FloatN>& surface,
                     const MaskN& lanes) const;
  MaskN scatter(LightPathPacket& path, MediumStack& media, int depth, const Hits& hits,
                const SurfaceInteraction<FloatN>& surface, const MediumBoundary& boundary,
                const TexturePoint<FloatN>* point, const MaskN& lanes) const;
  static void append(Chunk& chunk, LightPathPacket& path, const MediumStack& media, const Hits& hits,
                     const IntN& material, const MaskN& lanes);

  int most_points_, roulette_depth_;
  StageClock& clock_;
  Chunk paths_, next_;
  std::vector<std::int32_t> order_;
};

}  // namespace raytrace
