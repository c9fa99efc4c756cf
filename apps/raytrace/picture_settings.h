// Which picture of the scene the command line asks for.
#pragma once

#include "options.h"
#include "raytrace/cameras/view_plane.h"
#include "raytrace/film/film.h"

namespace raytrace {

/// The scene's view plane with the asked resolution, scale and samples. Throws UsageError if the picture gets too
/// large.
ViewPlane asked_viewplane(const ViewPlane& viewplane, const Options& options);

/// Which of each pixel's samples: --sample-offset makes them a part of the picture's.
SampleRange sample_range(const ViewPlane& viewplane, const Options& options);

/// What is cut into tiles: the crop, or the whole picture. Throws UsageError if the crop reaches too far beyond the
/// picture.
Region crop_window(const ViewPlane& viewplane, const Options& options);

/// The tile or pixel of it, or all. Throws UsageError if there are more tiles than pixels, or no such pixel.
Region render_window(const Region& whole, const Options& options);

}  // namespace raytrace
