// Shadow catchers: objects of which a transparent picture shows nothing but the shadows on them.
//
// A camera ray that meets one first draws candidates of the light that would reach it if nothing were in the way: from
// every light, from shining surfaces, and from the environment. It chooses one of them in proportion to what it would
// bring, and sends a shadow ray there (resampled importance sampling; Talbot, Cline and Egbert 2005). Where that is
// hidden, the sample counts as a hit and is black, otherwise as a miss. So A becomes the share of the light that is
// hidden, and stays a count of whole samples, which any cut of the picture adds up to the same.
//
// Light that other catchers hide is missing in the photograph as well, so A is a share of the rest: the sample then
// chooses again.
#pragma once

#include <cstdint>
#include <span>

#include "raytrace/accel/traced_scene.h"
#include "raytrace/tracing/ray_result.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

/// Of a packet of camera rays.
struct CaughtShadows {
  MaskN counted{false};   ///< the lanes whose rays count
  MaskN shadowed{false};  ///< the lanes whose sample is a shadow
  std::uint64_t shadow_rays = 0;

  /// Adds them to what the integrator made of the packet, who saw nothing there. groups: its radiance by light groups,
  /// where it has that already.
  void add_to(RayResult& result, std::span<Rgb<FloatN>> groups, RayCounts& counts) const;
};

/// Whether the integrator shows what light there is, so that there are shadows to catch; for others, shadow catchers
/// are surfaces like any other.
bool integrator_catches_shadows(const SceneTables& tables);

/// Sets camera.caught. The result: the hits on all else.
Hits catch_shadows(const TracedScene& scene, const CameraRays& camera, const Hits& hits);

}  // namespace raytrace
