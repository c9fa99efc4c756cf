// Which picture of the scene the command line asks for.
#pragma once

#include "options.h"
#include "raytrace/description/view_plane.h"
#include "raytrace/film/film.h"

namespace raytrace {

/// The scene's view plane with the asked resolution, scale and samples. Throws UsageError if the picture gets too
/// large.
ViewPlane asked_viewplane(const ViewPlane& viewplane, const Options& options);

/// The crop, or the whole picture. Throws UsageError if the crop is not inside.
Region asked_region(const ViewPlane& viewplane, const Options& options);

}  // namespace raytrace
