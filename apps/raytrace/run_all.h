// Runs all renders of a command line, and makes an exit code of what they throw.
#pragma once

#include <cstddef>
#include <functional>

#include "raytrace/batch/render_job.h"

namespace raytrace {

/// Renders all jobs by `run`, which gets a job and its index, and gives an exit code or throws. One that fails does not
/// stop the others; in the end they are named, and what several have in common is reported for the first of them. The
/// exit code is the one that all that failed have in common, or exit_code::failed. A signal stops them all.
int run_all(const RenderBatch& batch, const std::function<int(const RenderJob&, std::size_t)>& run);

/// What `action` gives; if it throws, the exit code for that, and the error is reported.
int run_reporting_errors(const std::function<int()>& action);

}  // namespace raytrace
