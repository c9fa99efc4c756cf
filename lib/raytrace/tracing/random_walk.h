// Random walks of light that is scattered inside of things.
//
// Free flights and scatterings, until a surface is met (pbrt-v4, chapter 14). The colours of a path go the same way, in
// which each has a density of its own (the balance heuristic). A walk ends by roulette as its light becomes less, and
// in any case after 16,384 scatterings, which of a plane of the whitest colour takes half a percent of the light.
#pragma once

#include "raytrace/accel/traced_scene.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

/// Which paths they are, for random numbers.
struct WalkIds {
  const UintN& pixel;  ///< as CameraRays have them
  const UintN& sample;
  std::uint32_t walk;  ///< which walk of the path, below 2^17
  /// The lanes in which the camera sees by the paths' rays, up to the first scattering.
  MaskN seeing{false};
};

/// Where paths go in below surfaces, of which at least one lane has a hit.
struct SubsurfaceEntry {
  const Hits& hits;
  const SurfaceInteraction<FloatN>& surface;
  const Subsurface<FloatN>& inside;
};

/// Follows the paths of those lanes to where they come out of the object that they are below the surface of (Chiang,
/// Kutz and Burley, "Practical and Controllable Subsurface Scattering for Production Path Tracing", SIGGRAPH Talks
/// 2016). Other objects inside of it are not there for them. The object should be closed. Paths count how often they
/// came into it and out of it, so that its parts may overlap.
///
/// rays: where they start and go, of unit length; then of length 0, from outside to where they come out.
/// throughput: of the paths, times what is left of it. The result: what was hit, none of lanes that do not come out.
Hits walk_below(const TracedScene& scene, const SubsurfaceEntry& entry, const MaskN& lanes, const WalkIds& ids,
                Ray<FloatN>& rays, Rgb<FloatN>& throughput, RayCounts& counts);

struct MediumWalk {
  Hits hits;              ///< the next surfaces, none of lanes whose light has gone
  MaskN scatters{false};  ///< the lanes that did not come there straight
};

/// Follows the paths of those lanes through the media that they are in to the next surfaces. rays: where they start and
/// go; then the last part of their ways. The rest as above.
MediumWalk walk_through(const TracedScene& scene, const IntN& medium, const MaskN& lanes, const WalkIds& ids,
                        Ray<FloatN>& rays, Rgb<FloatN>& throughput, RayCounts& counts);

}  // namespace raytrace
