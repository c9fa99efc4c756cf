// The distance of a ray's places from a torus, and its roots.
#pragma once

#include "raytrace/math/doubles.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// The torus along a ray, of which only this matters: its point closest to the center, and its direction, along the
/// torus' axis and across. The place s on it is that point plus s times the direction. N: floats or doubles.
template <class N>
struct TorusProfile {
  N distance2;  ///< of the closest point from the center, squared
  N height;     ///< of the closest point along the axis
  N length2;    ///< of the direction, squared
  N climb;      ///< of the direction along the axis
  N swept, tube;

  /// A place on the ray: its height along the axis, and its distance from the axis.
  struct Place {
    N y, rho;
  };
  RAYTRACE_INLINE Place place(const N& s) const {
    const N y = multiply_add(climb, s, height);
    return {y, sqrt(max(multiply_add(length2 * s, s, distance2) - y * y, N(0.0F)))};
  }

  /// Positive outside of the torus, negative inside its tube. As a difference of lengths, (rho - R)^2 + y^2 - r^2, it
  /// keeps the digits that the quartic loses when the tube is thin. `side` is 1, or -1 for the inner sheet
  /// (the "lemon") of a torus whose tube is wider than its hole.
  RAYTRACE_INLINE N distance_form(const Place& at, const N& side) const {
    const N from_circle = at.rho - side * swept;
    return multiply_add(from_circle, from_circle, (at.y - tube) * (at.y + tube));
  }

  /// Of the quartic's sign: its two factors are the distance forms of both sheets.
  struct Sign {
    N value;
    N least;  ///< the smaller form's size
  };
  RAYTRACE_INLINE Sign sign(const Place& at) const {
    const N outer = distance_form(at, N(1.0F)), inner = distance_form(at, N(-1.0F));
    return {select(inner < N(0.0F), -outer, outer), min(abs(outer), abs(inner))};
  }

  /// One of Newton's steps towards a root of the distance form.
  struct Step {
    N value, step;
    N remaining;  ///< an estimate of the way from there to the root: from the second derivative
  };
  RAYTRACE_INLINE Step newton_step(const N& s, const N& side) const {
    const Place at = place(s);
    const N from_circle = at.rho - side * swept;
    const N value = distance_form(at, side);
    // The slope is 2 (from_circle * (length2 s - y climb) / rho + y climb), the second derivative at most
    // 2 length2 (1 + |from_circle| / rho): one division does for all.
    const N climbing = at.y * climb;
    const N slope_rho = N(2.0F) * multiply_add(from_circle, length2 * s - climbing, climbing * at.rho);
    const N inverse = N(1.0F) / slope_rho;
    const N step = value * at.rho * inverse;
    return {value, step, length2 * step * step * abs((at.rho + abs(from_circle)) * inverse)};
  }
};

/// When a root is found: after a step of at most this length, or with at most so much remaining.
template <class N>
struct Precision {
  N step, remaining;
  int most_steps;
};

/// The root of the distance form between left and right, where it has different signs and one root: Newton's method
/// from `s`, and bisection where that would leave the bracket.
template <class N>
RAYTRACE_INLINE N root_in_bracket(const TorusProfile<N>& profile, const N& side, N s, N left, N right,
                                  const N& left_sign, const Precision<N>& wanted) {
  auto moving = left <= right;  // all that have a bracket; lanes that have arrived stay, whatever the others do
  for (int i = 0; i < wanted.most_steps; ++i) {
    const auto at = profile.newton_step(s, side);
    const auto still_left = at.value * left_sign > N(0.0F);
    left = select(still_left, s, left);
    right = select(still_left, right, s);
    const N newton = s - at.step;
    const auto inside = (newton >= left - wanted.step) & (newton <= right + wanted.step);
    const N next = select(inside, min(max(newton, left), right), N(0.5F) * (left + right));
    const N remaining = select(inside, at.remaining, right - left);
    const auto on_the_way = (abs(next - s) > wanted.step) & (remaining > wanted.remaining);
    s = select(moving, next, s);
    moving = moving & on_the_way;
    if (!any(moving)) break;
  }
  return s;
}

}  // namespace raytrace
