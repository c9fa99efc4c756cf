// Photons: light that mirrors, metals and clear glass send onto surfaces which the camera does not see straight away,
// but in mirrors, through glass, or by the light that these pass on.
//
// Neither paths from the camera nor those from the lights bring it but by chance. So paths from the lights leave their
// last points as photons, and paths from the camera look them up at all points but their first (Jensen 2001). Each pass
// of a few samples has photons of its own, within a radius that shrinks from pass to pass, so that the picture
// converges (Knaus and Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", 2011).
#pragma once

#include <atomic>
#include <cstdint>

#include "raytrace/accel/traced_scene.h"
#include "raytrace/film/film.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

/// Gives the film the photons of that pass, unless it has them. They depend on the scene, the size of the picture, the
/// film's seed and the pass. The scene must have photons. Once `stop` is set (null: never), the film may be left
/// without. Throws std::bad_alloc.
RenderReport trace_photons(const TracedScene& scene, std::uint32_t pass, int threads, const std::atomic<bool>* stop,
                           Film& film);

}  // namespace raytrace
