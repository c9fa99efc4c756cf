// From pixels to camera rays, and from radiance to the film: the innermost loop.
#pragma once

#include <atomic>

#include "raytrace/accel/traced_scene.h"
#include "raytrace/film/film.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

/// Kernel::radiance_range() of the scene's integrator.
RadianceRange radiance_range(const SceneTables& scene);

/// Renders the tile's pixels as Variant::render promises. Packets are blocks of neighbouring pixels, aligned to the
/// picture's own grid: a pixel shares its packet with the same neighbours however the picture is cut, so its bits do
/// not change.
RenderReport render_tile(const TracedScene& scene, const Region& tile, std::uint32_t samples, Film& film,
                         const std::atomic<bool>* stop);

}  // namespace raytrace
