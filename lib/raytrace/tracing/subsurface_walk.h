// Random walks of light below surfaces.
#pragma once

#include "raytrace/accel/traced_scene.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

/// Where paths go in below surfaces, of which at least one lane has a hit.
struct SubsurfaceEntry {
  const Hits& hits;
  const SurfaceInteraction<FloatN>& surface;
  const Subsurface<FloatN>& inside;
  const UintN& pixel;  ///< as CameraRays have them
  const UintN& sample;
  int depth;  ///< of the path
};

/// Follows the paths of those lanes to where they come out: free flights and scatterings inside of the object that they
/// are below the surface of, as Chiang, Kutz and Burley have them ("Practical and Controllable Subsurface Scattering
/// for Production Path Tracing", SIGGRAPH Talks 2016). Other objects inside of it are not there for them. The colours
/// of a path go the same way, each with its own density (the balance heuristic).
///
/// The object should be closed. Paths count how often they came into it and out of it, so that its parts may overlap. A
/// walk ends by roulette as its light becomes less, and in any case after 16,384 scatterings, which of a plane of the
/// whitest colour takes half a percent of the light.
///
/// rays: where they start and go, of unit length; then of length 0, from outside to where they come out.
/// throughput: of the paths, times what is left of it. The result: what was hit, none of lanes that do not come out.
Hits walk_below(const TracedScene& scene, const SubsurfaceEntry& entry, const MaskN& lanes, Ray<FloatN>& rays,
                Rgb<FloatN>& throughput, RayCounts& counts);

}  // namespace raytrace
