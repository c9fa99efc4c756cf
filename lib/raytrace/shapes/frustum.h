// What cones and cylinders share: the stretch of a ray inside of them, with their ends.
#pragma once

#include <limits>

#include "raytrace/math/doubles.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

/// A truncated cone. N: double, or Doubles where lanes have different ones.
template <class N>
struct Frustum {
  Vec3<N> bottom;
  Vec3<N> axis;  ///< unit length, from bottom to top
  N height;
  N radius;    ///< at the bottom
  N widening;  ///< of the radius, per unit of height
  N caps;      ///< 1 if it has any, else 0
};

inline void add_frustum_patches(const Frustum<double>& frustum, std::vector<LightPatch>& patches) {
  const auto& [bottom, axis, height, radius, widening, caps] = frustum;
  const double top_radius = radius + widening * height;
  patches.push_back({PatchShape::band, bottom, axis, {radius, top_radius, height}});
  if (caps == 0) return;
  if (radius > 0) patches.push_back({PatchShape::band, bottom, axis, {0, radius, 0}});
  if (top_radius > 0) patches.push_back({PatchShape::band, bottom + axis * height, axis, {top_radius, 0, 0}});
}

/// A ray and a frustum: along the axis, and across it, where the frustum is a circle of a radius that changes with the
/// height. D: doubles.
template <class D>
struct FrustumRay {
  /// From where the ray enters to where it leaves; nowhere if entry <= exit is false.
  struct Stretch {
    D entry, exit;
  };

  Frustum<D> frustum;
  D start;  ///< of the distances below: the ray's point closest to the middle of the axis, so that nothing cancels
  Vec3<D> across, across_speed;
  D height, climb;
  Stretch side, ends;

  RAYTRACE_INLINE FrustumRay(const Frustum<D>& of, const Vec3<D>& origin, const Vec3<D>& direction) : frustum(of) {
    const Vec3<D>& axis = frustum.axis;
    const Vec3<D> to_middle = frustum.bottom - origin + axis * (frustum.height * D(0.5));
    start = dot(to_middle, direction) / dot(direction, direction);
    const Vec3<D> from_middle = direction * start - to_middle;
    const D above_middle = dot(from_middle, axis);
    height = above_middle + frustum.height * D(0.5);
    climb = dot(direction, axis);
    across = from_middle - axis * above_middle;
    across_speed = direction - axis * climb;
    // Of the circle: at the start, and how it grows along the ray.
    const D radius = radius_at(height), growth = frustum.widening * climb;

    const D infinite(std::numeric_limits<double>::infinity()), zero(0.0);
    const D slowest(1e-200);  // so that a level ray gives large numbers, and no 0 / 0
    const D inverse = D(1.0) / select(abs(climb) < slowest, slowest, climb);
    const D at_bottom = -height * inverse, at_top = (frustum.height - height) * inverse;
    ends = {min(at_bottom, at_top), max(at_bottom, at_top)};

    // The distance from the axis equals the radius where a t^2 + 2 b t + c = 0. b^2 - a c as a difference of squares
    // of lengths: both are small where the ray grazes.
    const D speed2 = dot(across_speed, across_speed);
    const D a = speed2 - growth * growth;
    const D b = dot(across, across_speed) - growth * radius;
    const D c = dot(across, across) - radius * radius;
    const D faster = length(across_speed * radius - across * growth), passing = length(cross(across, across_speed));
    const D discriminant = (faster - passing) * (faster + passing);
    const auto is_steep = a < zero;  // steeper than the cone: the ray is inside from one place on, or up to one
    const D root = sqrt(max(discriminant, zero));
    const D q = select(b < zero, root - b, -root - b);
    const auto is_single = abs(q) <= zero;  // the ray touches at its start, where both quotients may be 0 / 0
    const D first = select(is_single, zero, q / a), second = select(is_single, zero, c / q);
    const D low = min(first, second), high = max(first, second);
    side.entry = select(is_steep, select(growth > zero, high, -infinite), low);
    side.exit = select(is_steep, select(growth > zero, infinite, low), high);
    // Along the axis of a cylinder everything is inside, or nothing.
    const auto is_along = (speed2 <= zero) & (abs(growth) <= zero);
    const auto is_inside = select(is_along, c, select(is_steep, -D(1.0), -discriminant)) <= zero;
    side.entry = select(is_inside, select(is_along, -infinite, side.entry), infinite);
    side.exit = select(is_inside, select(is_along, infinite, side.exit), -infinite);
  }

  RAYTRACE_INLINE D radius_at(const D& y) const { return multiply_add(frustum.widening, y, frustum.radius); }

  /// Inside of the frustum with its ends.
  RAYTRACE_INLINE Stretch inside() const { return {max(side.entry, ends.entry), min(side.exit, ends.exit)}; }

  /// The nearest distance inside (near, far), or infinity.
  RAYTRACE_INLINE D nearest(bool has_caps, const D& near, const D& far) const {
    const D infinite(std::numeric_limits<double>::infinity());
    if (has_caps) {
      const Stretch stretch = inside();
      const D entry = start + stretch.entry, exit = start + stretch.exit, t = select(entry > near, entry, exit);
      return select((stretch.entry <= stretch.exit) & (t > near) & (t < far), t, infinite);
    }
    // Rays down the axis must not slip past the tip.
    const D slack = frustum.height * D(1e-12), highest = frustum.height + slack;
    const auto hit = [&](const D& at) {
      const D h = multiply_add(climb, at, height), t = start + at;
      return (h >= -slack) & (h <= highest) & (t > near) & (t < far);
    };
    return select(hit(side.entry), start + side.entry, select(hit(side.exit), start + side.exit, infinite));
  }

  /// The surface at a distance that nearest() gave.
  template <class F>
  RAYTRACE_INLINE SurfacePoint<F> surface(const D& distance) const {
    const D at = distance - start, zero(0.0), tiny(1e-300);
    const Stretch stretch = inside();
    const auto leaves = abs(stretch.exit - at) < abs(stretch.entry - at);
    const D side_over_ends = select(leaves, ends.exit - side.exit, side.entry - ends.entry);
    const auto on_cap = (frustum.caps > zero) & (side_over_ends < zero);
    const Vec3<D> p = across + across_speed * at;
    const D h = multiply_add(climb, at, height), rho = max(length(p), tiny);
    const Vec3<D> out = p * (D(1.0) / rho);
    // The foot on the side's line; its ends are the rims.
    const D slant2 = multiply_add(frustum.widening, frustum.widening, D(1.0));
    const D foot = multiply_add(frustum.widening, (rho - radius_at(h)) / slant2, h);
    const auto at_top = h + h > frustum.height;
    const D end = select(at_top, frustum.height, zero);
    const D y = select(on_cap, end, min(max(foot, zero), frustum.height));
    const D r = select(on_cap, min(rho, radius_at(end)), radius_at(y));
    const Vec3<D> side_normal = normalize(out - frustum.axis * frustum.widening);  // at the tip, along the axis
    const Vec3<F> position = to_float(frustum.bottom + frustum.axis * y + out * r);
    const Vec3<D> cap_normal = select(at_top, frustum.axis, -frustum.axis);
    return {position, to_float(select(on_cap, cap_normal, side_normal)), rounding_error(position, F(0))};
  }
};

/// u: the angle about the axis. v: along it, from bottom to top; on a cap the distance from the axis, 1 at the rim.
template <class F>
SurfaceUv<F> frustum_uv(const Frustum<Doubles<F>>& frustum, const Vec3<F>& position, const Vec3<F>& normal) {
  using D = Doubles<F>;
  const Vec3<D> from_bottom = Vec3<D>(position) - frustum.bottom;
  const D h = dot(from_bottom, frustum.axis);
  const Vec3<F> axis = to_float(frustum.axis), across = to_float(from_bottom - frustum.axis * h);
  const F rho = length(across), height = frustum.height.to_float(), widening = frustum.widening.to_float();
  // A cap's normal has nothing across the axis; that of the side has this.
  const F across_normal = F(1) / sqrt(multiply_add(widening, widening, F(1)));
  const F end = multiply_add(frustum.widening, select(h + h > frustum.height, frustum.height, D(0.0)), frustum.radius)
                    .to_float();  // its radius: at a tip there is no cap
  const Mask<F> on_cap = (frustum.caps.to_float() > F(0)) & (end > frustum.radius.to_float() * F(1e-9F)) &
                         (abs(dot(normal, across)) <= rho * across_normal * F(0.5F));
  const SurfaceUv<F> cap = ring_uv(axis, across, F(0), end);
  return select(on_cap, cap,
                SurfaceUv<F>{cap.u, (h / frustum.height).to_float(), cap.dpdu,
                             (axis + across * (widening / max(rho, F(1e-30F)))) * height});
}

}  // namespace raytrace
