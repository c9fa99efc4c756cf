// Where rays that leave a surface start: the one place that decides it. No other code has an epsilon for this.
#pragma once

#include "raytrace/math/ray.h"

namespace raytrace {

/// The surface point moved along its normal, to the normal's side, just so far that neither its own rounding nor that
/// of an intersection with the surface it lies on can put it on the other side: a few units in the last place of its
/// largest coordinate. Wächter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems
/// chapter 6, argue why the distance must scale so.
template <class F>
RAYTRACE_INLINE Vec3<F> offset_ray_origin(const SurfacePoint<F>& point) {
  return point.position + point.normal * (point.error * F(4));
}

}  // namespace raytrace
