// Axis-aligned boxes.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/math/vec3.h"

namespace raytrace {

struct Bounds {
  Vec3f lower, upper;
};

/// The box around center +- extent in double, rounded outwards to floats.
inline Bounds bounds_around(const Vec3d& center, const Vec3d& extent) {
  const auto down = [](double value) {
    return std::nextafterf(static_cast<float>(value), -std::numeric_limits<float>::infinity());
  };
  const auto up = [](double value) {
    return std::nextafterf(static_cast<float>(value), std::numeric_limits<float>::infinity());
  };
  return {{down(center.x - extent.x), down(center.y - extent.y), down(center.z - extent.z)},
          {up(center.x + extent.x), up(center.y + extent.y), up(center.z + extent.z)}};
}

}  // namespace raytrace
