// What a picture that is to be without noise asks of its render, and of its merge.
#pragma once

#include <optional>

#include "raytrace/batch/render_job.h"
#include "raytrace/batch/render_observer.h"
#include "raytrace/batch/render_statistics.h"
#include "raytrace/output/denoised_picture.h"

namespace raytrace {

/// What the film of a job gathers: the job's AOVs, and those that denoising looks at.
AovSet film_aovs(const RenderJob& job);

/// Whether the job's own picture is denoised. Pieces of a picture are when they are merged.
bool is_denoised(const RenderJob& job);

enum class Denoising {
  done,
  stopped,  ///< by RenderControl::stop()
  failed,   ///< which the observer knows: the picture keeps its noise
};

/// Sets `denoised` to the film's colours if it can be done.
Denoising denoise(const Film& film, const RenderJob& job, RenderObserver& observer, const RenderControl& control,
                  RenderStatistics& statistics, std::optional<DenoisedPicture>& denoised);

}  // namespace raytrace
