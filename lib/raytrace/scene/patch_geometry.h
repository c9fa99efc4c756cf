// What patches are in space.
#pragma once

#include <optional>

#include "raytrace/math/affine.h"
#include "raytrace/math/bounds.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

/// A parallelogram or a triangle.
bool is_flat(const LightPatch& patch);

/// The patch under a map; scale: of all lengths, 0: not of all the same. None if it is no patch any more: round ones
/// but spheres, disks and annuli that are stretched, and spheres and annuli that are stretched too far for floats: to
/// less than about 1/128 across two axes, or 1/2000 across one; annuli to less than 1/10000.
std::optional<LightPatch> transformed(const LightPatch& patch, const Affine& affine, double scale);

/// Of ellipsoids, which have no closed form, about that; no less.
double area_of(const LightPatch& patch);

Bounds box_of(const LightPatch& patch);

}  // namespace raytrace
