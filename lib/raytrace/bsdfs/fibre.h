// Functions that say where a round fibre sends light: along its axis, and around it.
#pragma once

#include <cmath>
#include <numbers>

#include "raytrace/math/simd.h"

namespace raytrace {

/// exp(-x) times the modified Bessel function of the first kind and order 0, of x >= 0. Abramowitz and Stegun,
/// "Handbook of Mathematical Functions", 9.8.1 and 9.8.2, to 2e-7. T: a batch.
template <class T>
T scaled_bessel_i0(const T& x) {
  const T bounded = max(x, T(3.75F)), t = T(3.75F) / bounded;
  T sum(0.00392377F);
  for (const float c :
       {-0.01647633F, 0.02635537F, -0.02057706F, 0.00916281F, -0.00157565F, 0.00225319F, 0.01328592F, 0.39894228F})
    sum = multiply_add(sum, t, T(c));
  const T of_large = sum / sqrt(bounded);
  const Mask<T> is_small = x < T(3.75F);
  if (none(is_small)) return of_large;
  const T s = x * x * T(1 / (3.75F * 3.75F));
  T small(0.0045813F);
  for (const float c : {0.0360768F, 0.2659732F, 1.2067492F, 3.0899424F, 3.5156229F, 1.0F})
    small = multiply_add(small, s, T(c));
  return select(is_small, small * exp(-min(x, T(3.75F))), of_large);
}

/// How light is spread along the fibre, whose angle with the plane across it is theta: a Gaussian on the sphere about
/// the mirrored direction, convolved along circles about the axis, and normalised: times cos(theta) it has the integral
/// 1 over theta in [-pi/2, pi/2] (d'Eon et al., "An Energy-Conserving Hair Reflectance Model", 2011).
///
/// With 1 / (2 v sinh(1 / v)) = exp(-1 / v) / (v (1 - exp(-2 / v))), all exponents together are
/// (cos(theta_i + theta_o) - 1) / v, which is written without any cancellation: this form is as good for the least
/// variance as for the largest.
template <class T>
struct LongitudinalLobe {
  T sine, cosine;  ///< of theta of wo
  T variance;
  T scale;  ///< scale_of() the variance

  /// 1 / (v (1 - exp(-2 / v))). Number: double, or a batch.
  template <class Number>
  static Number scale_of(const Number& v) {
    using std::expm1;
    return Number(-1) / (v * expm1(Number(-2) / v));
  }

  /// For theta of wi.
  T density(const T& sine_i, const T& cosine_i) const {
    const T along = sine_i + sine, across = cosine_i - cosine, inverse = T(1) / variance;
    return scaled_bessel_i0(cosine_i * cosine * inverse) * scale *
           exp((along * along + across * across) * inverse * T(-0.5F));
  }
  /// The sine of theta of a wi that is drawn. u: in [0, 1). cosine_of_turn: of an angle that is drawn evenly. d'Eon et
  /// al., "Importance Sampling for Physically-Based Hair Fiber Models", 2013.
  T sample(const T& u, const T& cosine_of_turn) const {
    const T least = exp(T(-2) / variance);
    // 1 - cosine of the angle with the mirrored direction.
    const T height = min(-variance * log(max(u + (T(1) - u) * least, T(1e-30F))), T(2));
    const T cosine_about = T(1) - max(height, T(0)), sine_about = sqrt(max(height * (T(2) - height), T(0)));
    return min(max(sine_about * cosine_of_turn * cosine - cosine_about * sine, T(-1)), T(1));
  }
};

/// How light is spread around the fibre: the logistic distribution, cut at half a turn to either side.
template <class T>
struct AzimuthalLobe {
  T scale;         ///< of the logistic distribution, in radians
  T inverse_part;  ///< inverse_part_of() the scale

  /// One over the share of the uncut distribution within half a turn. Number: double, or a batch.
  template <class Number>
  static Number inverse_part_of(const Number& scale) {
    using std::exp;
    const Number outside = exp(Number(-std::numbers::pi_v<float>) / scale);
    return (Number(1) + outside) / (Number(1) - outside);
  }

  /// Per radian, so far from its middle in turns; at most half of one.
  T density(const T& turns) const {
    const T e = exp(abs(turns) * T(-2 * std::numbers::pi_v<float>) / scale), one = T(1) + e;
    return e / (scale * one * one) * inverse_part;
  }
  /// Turns from its middle. u: in [0, 1).
  T sample(const T& u) const {
    // The half that u is in, from the middle: x / (1 - x) would be rounded to infinity far above it.
    const T away = abs(u - T(0.5F)), share = T(0.5F) - away / inverse_part;
    const T size = scale * log((T(1) - share) / max(share, T(1e-30F)));
    const T turns = min(size * T(0.5F * std::numbers::inv_pi_v<float>), T(0.5F));
    return select(u < T(0.5F), -turns, turns);
  }
};

}  // namespace raytrace
