// Rays and where they end.
#pragma once

#include "raytrace/math/vec3.h"

namespace raytrace {

/// The points origin + t * direction with near < t < far, in every lane of F. The direction may have any length but 0:
/// distances count in multiples of it.
template <class F>
struct Ray {
  Vec3<F> origin;
  Vec3<F> direction;
  F near;
  F far;

  RAYTRACE_INLINE Vec3<F> at(const F& t) const { return origin + direction * t; }
};

/// Rays that all start at one point, and of which all else stands elsewhere. Shapes that take them as they take a Ray
/// do once what is the same for all.
template <class F>
struct RaysFromPoint {
  Vec3<float> origin;
  const Vec3<F>& direction;
  const F& near;
  const F& far;
};

/// The point of a surface that a ray hit.
template <class F>
struct SurfacePoint {
  Vec3<F> position;  ///< on the surface as closely as floats allow, not merely on the ray
  Vec3<F> normal;    ///< unit length, to either side
  F error;           ///< bound of the distance between `position` and the true surface
};

/// A point of a surface without its normal.
template <class F>
struct SurfacePosition {
  Vec3<F> position;
  F error;
};

/// Lane by lane: a where the mask is true, else b.
template <class F, class MaskType>
RAYTRACE_INLINE SurfacePoint<F> select(const MaskType& mask, const SurfacePoint<F>& a, const SurfacePoint<F>& b) {
  return {select(mask, a.position, b.position), select(mask, a.normal, b.normal), select(mask, a.error, b.error)};
}

/// Bound of the rounding errors of a point computed in float from numbers of its own magnitude and of `size`.
template <class F>
RAYTRACE_INLINE F rounding_error(const Vec3<F>& position, const F& size) {
  return max(largest_component(position), size) * F(4 * 0x1p-24f);
}

}  // namespace raytrace
