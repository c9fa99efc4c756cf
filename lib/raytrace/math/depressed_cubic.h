// The roots of a cubic without a square term.
#pragma once

#include "raytrace/math/simd.h"

namespace raytrace {

namespace detail {

/// A number above the cube root of a positive one, by an eighth at most: a third of its exponent.
template <class F>
RAYTRACE_INLINE F above_cbrt(const F& x) {
  const F third = to_float(same_bits<Ints<F>>(x)) * F(1 / 3.0F);
  return F(1.07F) * same_bits<F>(to_int(third) + Ints<F>(0x2a514067));
}

}  // namespace detail

/// The real roots of s^3 + p s + q, where its value is within 1e-5 of the largest of its terms, in ascending order.
/// Where there is only one, it stands in all three places.
template <class F>
RAYTRACE_INLINE void depressed_cubic_roots(const F& p, const F& q, F (&root)[3]) {
  // The root on the far side of q's sign always exists and is simple. From beyond it, Newton's method comes down to it
  // monotonically. It is at most u + d where s^3 + p s >= d^3 and >= 2 u^2 d, u^2 = -p, and, where p is positive, at
  // most the lesser of cbrt(|q|) and |q| / p.
  const F zero(0.0F);
  const F abs_q = abs(q);
  const F u2 = max(-p, zero);
  const F quotient = abs_q / max(select(p < zero, u2 + u2, p), F(1e-30F));
  F s = (sqrt(u2) + min(detail::above_cbrt(abs_q), quotient)) * F(1 + 0x1p-20F);
  Mask<F> moving(true);  // lanes that have arrived stay, whatever the others do
  for (int i = 0; i < 40; ++i) {
    const F slope = multiply_add(F(3.0F) * s, s, p);
    const F step = multiply_add(multiply_add(s, s, p), s, -abs_q) / max(slope, F(1e-30F));
    s = select(moving, s - step, s);
    moving = moving & (step > s * F(1e-3F));  // it converges quadratically
    if (none(moving)) break;
  }
  const F first = select(q < zero, s, -s);
  // The other two are the roots of the quotient s^2 + first s + (first^2 + p).
  const F discriminant = -multiply_add(F(3.0F) * first, first, F(4.0F) * p);
  const F half_width = F(0.5F) * sqrt(max(discriminant, zero));
  const F middle = F(-0.5F) * first;
  const auto single = discriminant < zero;
  const F low = select(single, first, middle - half_width), high = select(single, first, middle + half_width);
  root[0] = min(first, low);
  root[2] = max(first, high);
  root[1] = select(single, first, max(min(first, high), min(max(first, low), high)));
}

}  // namespace raytrace
