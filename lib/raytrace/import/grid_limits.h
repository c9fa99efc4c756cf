// What grids may be, for all that read them; the module that reads OpenVDB's, too, which links nothing of the program.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "raytrace/import/density_grid.h"

namespace raytrace {

/// Why so many points, along each axis, are too many.
inline std::string too_many_points(const std::array<std::int64_t, 3>& points) {
  return "it is too large: " + std::to_string(points[0]) + " x " + std::to_string(points[1]) + " x " +
         std::to_string(points[2]) + " points, where the most are " + std::to_string(DensityGrid::most_cells) +
         " cells of 8 x 8 x 8, as 2047 x 2047 x 2047 points have";
}

}  // namespace raytrace
