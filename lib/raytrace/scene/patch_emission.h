// What the light tree knows of patches.
#pragma once

#include <span>

#include "raytrace/math/affine.h"
#include "raytrace/scene/light_tree.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

/// radiance: as MaterialEmission has it, on the mean.
LightEmission emission_of(const LightPatch& patch, float radiance, bool two_sided);

/// Of one that moves: all that it reaches, and its power on the mean. moments: its maps to the world, at even
/// distances; in between they change evenly.
LightEmission emission_of(const LightPatch& patch, std::span<const Affine> moments, float radiance, bool two_sided);

/// Of the patch under a map; of round ones, about that.
double area_under(const LightPatch& patch, const Affine& affine);

}  // namespace raytrace
