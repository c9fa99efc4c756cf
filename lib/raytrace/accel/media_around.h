// Which media points are in.
#pragma once

#include "raytrace/accel/accelerator.h"
#include "raytrace/scene/medium_table.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

/// The media around the points of those lanes: those that a ray upwards comes out of without having come into them.
/// Surfaces must be closed for that, or above the points, as water is. ids: of rays that start there, at whose time
/// things are where they are; without them, the shutter opens. camera_sees: without what is not visible to the camera.
MediumStack media_around(const SceneTables& tables, const Accelerator& accelerator, const Vec3<FloatN>& points,
                         const MaskN& lanes, const RayIds* ids = nullptr, bool camera_sees = false);

}  // namespace raytrace
