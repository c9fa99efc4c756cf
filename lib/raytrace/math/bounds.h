// Axis-aligned boxes.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/math/inline.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

struct Bounds {
  Vec3f lower, upper;
};

struct BoundingSphere {
  Vec3d center;
  double radius;
};

/// Around nothing: what it is joined with stays as it is.
inline constexpr Bounds empty_bounds = [] {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return Bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}();

inline Bounds join(const Bounds& a, const Bounds& b) {
  return {{std::min(a.lower.x, b.lower.x), std::min(a.lower.y, b.lower.y), std::min(a.lower.z, b.lower.z)},
          {std::max(a.upper.x, b.upper.x), std::max(a.upper.y, b.upper.y), std::max(a.upper.z, b.upper.z)}};
}

/// The sphere through the box's corners.
inline BoundingSphere sphere_around(const Bounds& box) {
  const Vec3d lower(box.lower), upper(box.upper);
  return {(lower + upper) * 0.5, length(upper - lower) / 2};
}

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

/// Whether rays may be in the box between near and far: where rounding cannot tell, they may. From however far they
/// come.
template <class F>
RAYTRACE_INLINE auto may_cross(const Bounds& box, const Ray<F>& ray) {
  // Of the distances' own rounding, and more.
  constexpr float rounding = 1e-5f;
  F near = ray.near, far = ray.far;
  const auto stay_between = [&](float lower, float upper, const F& origin, const F& direction) RAYTRACE_INLINE_LAMBDA {
    // So small a component goes nowhere, and a quotient by 0 might be no number.
    const F along = select(abs(direction) < F(1e-30f), F(1e-30f), direction);
    const F a = (F(lower) - origin) / along, b = (F(upper) - origin) / along;
    near = max(near, min(a, b));
    far = min(far, max(a, b));
  };
  stay_between(box.lower.x, box.upper.x, ray.origin.x, ray.direction.x);
  stay_between(box.lower.y, box.upper.y, ray.origin.y, ray.direction.y);
  stay_between(box.lower.z, box.upper.z, ray.origin.z, ray.direction.z);
  return near <= far * F(1 + rounding);
}

}  // namespace raytrace
