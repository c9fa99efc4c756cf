// From a description to pixels: what programs call. No SIMD type appears here; the wide part stands behind Scene,
// compiled once for each instruction set (variants/variant.h).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "raytrace/description/scene_description.h"
#include "raytrace/film/film.h"
#include "raytrace/variants/variant.h"

namespace raytrace {

struct RenderSettings {
  int threads = 0;  ///< 0: all processors; at most these work, and at most as many as a living scene was built with
  std::uint64_t seed = 0;  ///< another seed gives another, equally good, pattern of samples
  Region region{};         ///< the pixels wanted, those outside are not in the film; not set: the whole picture
  std::optional<SampleRange> samples = std::nullopt;  ///< none: as many as the scene says, from the first on
  AovSet aovs{};
  bool transparent = false;  ///< FilmSettings::transparent
  Region whole{};  ///< the picture or crop that the region is of: films with light paths hold it; not set: the region
  bool single_splats = false;  ///< FilmSettings::single_splats, if there are light paths
};

struct RenderProgress {
  double fraction = 0;  ///< that is done
  ErrorEstimate error;  ///< RenderReport::error of that part
};

/// Receives how much of a render is done. Calls come from any thread, one at a time and not often.
using ProgressFunction = std::function<void(const RenderProgress& progress)>;

/// Of a film for a render of the scene with the settings. Throws SceneError if the description's view plane breaks the
/// rules, and RenderError for a region without pixels or for no samples.
FilmSettings film_settings(const Scene& scene, const SceneDescription& description, const RenderSettings& settings);

/// Where sums cannot hold both the scene's brightest light and its dimmest: what radiance is rounded to.
std::optional<std::string> rounding_warning(const Scene& scene, const FilmSettings& film);

/// Continues the film until each pixel has `samples` (at most the film's own). Returns early once `stop` is set; the
/// film keeps what was done, and another call goes on from there: of sums, that is. A film of means is rendered by one
/// call, with all its samples. threads: as RenderSettings::threads.
RenderReport render(const Scene& scene, Film& film, std::uint32_t samples, int threads,
                    const ProgressFunction& progress = {}, const std::atomic<bool>* stop = nullptr);

/// The picture as a whole: makes the film and renders all its samples.
Film render(const Scene& scene, const SceneDescription& description, const RenderSettings& settings, RayCounts& rays,
            const ProgressFunction& progress = {}, const std::atomic<bool>* stop = nullptr);

/// The matrices that image metadata carries for the description's camera.
CameraMatrices camera_matrices(const SceneDescription& description);

}  // namespace raytrace
