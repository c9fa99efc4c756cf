// How far shapes reach in a direction: what their reach() has in common. It is the largest dot product of the
// direction, of any length, with their points (the support function), or a little more.
#pragma once

#include "raytrace/math/vec3.h"

namespace raytrace {

/// Of a disk about the origin. normal: of any length but 0.
inline double reach_of_disk(const Vec3d& normal, double radius, const Vec3d& along) {
  return radius * length(cross(along, normal)) / length(normal);
}

}  // namespace raytrace
