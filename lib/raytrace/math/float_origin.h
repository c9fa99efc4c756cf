// Where to put (0, 0, 0), next to which floats are precise.
#pragma once

#include <cmath>

#include "raytrace/math/vec3.h"

namespace raytrace {

/// So near the origin, floats are precise enough for scenes of any usual size: their digits reach to 1 / 4096.
inline constexpr double near_the_origin = 4096;

/// Whether what is so large and so far away from the origin shows that its coordinates are floats: 128 sizes away they
/// are rounded by 2^-18 of its size.
inline bool is_coarse(double distance, double size) { return distance > 128 * size; }

/// The point, rounded to whole units, or to a power of two that is not larger than what lies there.
inline Vec3d rounded_origin(const Vec3d& point, double size) {
  const double unit = size > 0 && size < 1 ? std::ldexp(1.0, std::ilogb(size)) : 1;
  const auto rounded = [&](double value) { return std::round(value / unit) * unit; };
  return {rounded(point.x), rounded(point.y), rounded(point.z)};
}

}  // namespace raytrace
