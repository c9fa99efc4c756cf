// Strands of hair from files.
//
//   .hair    Cem Yuksel's (http://www.cemyuksel.com/research/hairmodels): binary, little-endian. A header of 128 bytes,
//            then the arrays that it says there are: the segments of each strand, points, thicknesses, transparencies,
//            colours. Thicknesses are diameters; transparencies are left out.
//   others   text, as Mitsuba's curves have it: a line "x y z radius" for each point, an empty line between strands.
//   The
//            radius may be missing, but of all or of none.
//
// Each may be compressed by gzip, with .gz behind the name. Strands with a point that is not finite or beyond 1e18,
// with a negative radius or of a single point are left out, with one warning that counts them.
//
// No array is allocated before it is known that the file has the values for it.
#pragma once

#include <optional>
#include <string>

#include "raytrace/import/curve_data.h"
#include "raytrace/import/read_mesh.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// No value, and errors, if the file cannot be read or is not what it should be. diagnostics: of that file.
std::optional<Strands> read_strands(const std::string& file, const MeshReadSettings& settings,
                                    Diagnostics& diagnostics);

}  // namespace raytrace
