// Renders a picture to its files: scene file -> description -> scene -> passes over the film -> image files.
//
//   RenderBatch batch({"scene.xml"}, frame_numbers("1-48"), job);       // render_job.h
//   for (std::size_t i = 0; i < batch.size(); ++i) render_picture(batch[i], observer, control);
#pragma once

#include <string>

#include "raytrace/batch/render_job.h"
#include "raytrace/batch/render_observer.h"
#include "raytrace/batch/render_statistics.h"
#include "raytrace/description/scene_description.h"

namespace raytrace {

enum class RenderOutcome {
  written,
  skipped,        ///< RenderJob::skip_existing, and all files were there
  invalid_scene,  ///< it has errors, which the observer knows
  failed,         ///< not all files could be written; the observer knows which
  stopped,  ///< by RenderControl::stop(). The checkpoint, if there is to be one, and the files as far as the picture is
            ///< done were written
};

struct RenderResult {
  RenderOutcome outcome = RenderOutcome::written;
  std::string kept;  ///< where it was stopped: the files that were written, and why others were not
  RenderStatistics statistics;
};

/// Renders the job's scene file. What comes out does not depend on checkpoints, pauses or threads.
///
/// Between passes over the picture it writes checkpoints, ends for a time limit, and does what `control` was asked for;
/// early passes are short, so that there is a whole picture soon. A picture whose film would not fit in 2 GiB goes to
/// its files band by band. The files appear whole or not at all, and a checkpoint is removed once they are written.
///
/// Throws SettingsError and OutputError for what is wrong before the render begins, InputError for a checkpoint that
/// does not fit, RenderError, SceneError or std::bad_alloc.
RenderResult render_picture(const RenderJob& job, RenderObserver& observer, RenderControl& control);

/// The same for a scene that is made by hand, which is checked: throws SceneError.
RenderResult render_picture(const RenderJob& job, SceneDescription description, RenderObserver& observer,
                            RenderControl& control);

}  // namespace raytrace
