// From pixels to camera rays, and from radiance to the film: the innermost loop.
#pragma once

#include "raytrace/film/film.h"
#include "raytrace/render/renderer.h"

namespace raytrace {

class TracedScene;

/// Renders the region's pixels as Scene::render_region promises. Packets are blocks of neighbouring pixels, aligned to
/// the picture's own grid: a pixel shares its packet with the same neighbours however the picture is cut, so its bits
/// do not change.
RenderReport render_pixels(const TracedScene& scene, const Region& region, std::uint32_t samples, Film& film,
                           const std::atomic<bool>* stop);

}  // namespace raytrace
