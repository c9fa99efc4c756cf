// What every job must keep, whoever made it: the command line or a program.
#pragma once

#include "raytrace/batch/render_job.h"

namespace raytrace {

/// Throws SettingsError for values that cannot be meant, such as tile 5 of 2, and for settings that exclude each other.
/// It knows neither scene nor files.
void require_good_job(const RenderJob& job);

}  // namespace raytrace
