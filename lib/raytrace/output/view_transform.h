// View transforms: from linear radiance, which has no upper end, to linear colour of a display, which has one.
#pragma once

#include "raytrace/cameras/view_plane.h"
#include "raytrace/math/color.h"

namespace raytrace {

/// Of finite linear Rec. 709 colour, whose negative parts count as 0; the result is linear Rec. 709, for the sRGB
/// curve. ViewTransform::srgb leaves it as it is; the others' results lie in [0, 1].
Rgb<double> view_transformed(ViewTransform transform, const Rgb<double>& color);

}  // namespace raytrace
