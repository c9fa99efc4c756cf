// What a job's film keeps of each pixel.
#pragma once

#include <algorithm>

#include "raytrace/batch/render_job.h"
#include "raytrace/description/light_groups.h"
#include "raytrace/film/film.h"
#include "raytrace/render/renderer.h"
#include "raytrace/scene/scene.h"

namespace raytrace {

/// Means where nobody asks for more: neither for samples to come after a while, nor for pieces to be put together, be
/// they stopped or not.
inline FilmContent job_film_content(const RenderJob& job, const Scene& scene, const SceneDescription& description,
                                    const RenderSettings& settings) {
  if (!job.checkpoint.empty() || job.time_limit || job.error_limit || job.sample_offset || job.display_server ||
      !settings.aovs.empty() || settings.region != whole_picture(description.viewplane) || scene.traces_light_paths() ||
      light_group_names(description).size() > 1)
    return FilmContent::sums;
  const bool halves = std::all_of(job.outputs.begin(), job.outputs.end(), [&](const std::string& file) {
    return image_format(file, job.image_file_settings()).halves();
  });
  return halves ? FilmContent::half_means : FilmContent::means;
}

}  // namespace raytrace
