// What renders rely on in meshes, clouds and curves, of those that a program has made in memory. Readers of files keep
// it.
#pragma once

#include "raytrace/description/parse_value.h"
#include "raytrace/import/curve_data.h"
#include "raytrace/import/mesh_data.h"

namespace raytrace {

/// Why they are refused: worded to follow "data that ". materials: how many the mesh may have. In the time that it
/// takes to read the data once.
OptionalMessage check_mesh_data(const MeshData& mesh, std::size_t materials);
OptionalMessage check_point_cloud(const PointCloud& cloud);
OptionalMessage check_curve_data(const CurveData& curves);

}  // namespace raytrace
