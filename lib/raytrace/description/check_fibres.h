// Materials of fibres are of curves alone.
#pragma once

#include "raytrace/description/scene_description.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Refuses objects that are no curves and have a material of fibres, as <hair> is, whether of their own, of their file
/// or from an instance.
void check_fibres(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace raytrace
