// Strands as the tracer has them: straight pieces in place of curves.
//
// Each segment of a curve, from one of its points to the next, becomes so many pieces of equal lengths of its parameter
// that they leave the curve by at most a fiftieth of the radius, or turn by at most 5 degrees from one to the next:
// whichever takes fewer, and at most 64. Thin hair so has as many as its outline needs, and no more.
//
// Positions are those of the basis; radii and colours change evenly from point to point, or, of a B-spline, as
// positions do, which keeps radii positive.
#pragma once

#include <cstddef>
#include <string>

#include "raytrace/import/curve_data.h"
#include "raytrace/shapes/curve.h"

namespace raytrace {

inline constexpr std::size_t most_pieces_of_segment = 64;

struct CutStrands {
  CurveData data;
  std::size_t left_out = 0;  ///< strands without length or radius, or, of a B-spline, with less than four points
  std::string fault;         ///< why there are none: they would be too many
};

/// The basis and the radii are those of the parameters. The result does not depend on the number of threads.
CutStrands cut_strands(const Strands& strands, const Curve::Parameters& parameters, int threads);

}  // namespace raytrace
