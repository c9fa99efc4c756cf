// raytrace SCENE.xml... -o FILE
#pragma once

#include "options.h"

namespace raytrace {

/// Renders each frame of each scene, or prints what is asked for instead; the program's exit code. Throws what
/// run_reporting_errors() reports.
int render_command(Options options);

}  // namespace raytrace
