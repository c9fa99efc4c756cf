// Texture coordinates of surfaces. What shapes share: angles about an axis, and directions in a plane.
//
// (0, 0) is the lower left of a surface seen from its front, y up. Angles start at +z and go towards +x where the axis
// is +y, as those of Suffern's chapter 29.
#pragma once

#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// The texture coordinates of a point of a surface, and how the point moves with them. Where a coordinate is an angle
/// that means nothing, at the pole of a sphere or the centre of a disk, a derivative is 0.
template <class F>
struct SurfaceUv {
  F u, v;
  Vec3<F> dpdu, dpdv;
};

/// Lane by lane: a where the mask is true, else b.
template <class F>
RAYTRACE_INLINE SurfaceUv<F> select(const Mask<F>& mask, const SurfaceUv<F>& a, const SurfaceUv<F>& b) {
  return {select(mask, a.u, b.u), select(mask, a.v, b.v), select(mask, a.dpdu, b.dpdu), select(mask, a.dpdv, b.dpdv)};
}

inline constexpr float one_turn = 6.2831853071795864769F;

/// Unit vectors across a normal: level and to the right for one that the normal points to, and up. A normal along y
/// has +x to its right.
template <class F>
struct TangentFrame {
  Vec3<F> right, up;

  RAYTRACE_INLINE explicit TangentFrame(const Vec3<F>& normal) {
    constexpr float upright = 1e-12F;  // rotations leave components of rounding's size
    const F level2 = normal.x * normal.x + normal.z * normal.z;
    const F inverse = F(1) / sqrt(max(level2, F(upright)));
    right =
        select(level2 > F(upright), Vec3<F>(normal.z * inverse, F(0), -normal.x * inverse), Vec3<F>(F(1), F(0), F(0)));
    up = cross(normal, right);
  }
};

/// The angle whose tangent is y / x, in turns from -1/2 to 1/2; 0 where both are 0.
template <class F>
RAYTRACE_INLINE F turns(const F& y, const F& x) {
  return atan2(y, select((x == F(0)) & (y == F(0)), F(1), x)) * F(1 / one_turn);
}

/// The angle of a vector about an axis of unit length, anticlockwise as seen from the axis' tip, in turns from 0 to 1:
/// u of all round shapes. It starts at the lowest place, or at +z where the axis is upright.
template <class F>
RAYTRACE_INLINE F turns_about(const Vec3<F>& axis, const Vec3<F>& v) {
  const TangentFrame<F> frame(axis);
  const F result = turns(dot(v, frame.right), -dot(v, frame.up));
  return select(result < F(0), result + F(1), result);
}

/// On a ring about an axis: u is the angle, v goes from the inner radius to the outer one.
template <class F>
RAYTRACE_INLINE SurfaceUv<F> ring_uv(const Vec3<F>& axis, const Vec3<F>& from_center, const F& inner, const F& outer) {
  const F rho = length(from_center), width = outer - inner;
  const F v = (rho - inner) / max(width, F(1e-30F));
  return {turns_about(axis, from_center), min(max(v, F(0)), F(1)), cross(axis, from_center) * F(one_turn),
          from_center * (width / max(rho, F(1e-30F)))};
}

}  // namespace raytrace
