// Sine and cosine of angles in turns, with the same arithmetic in every lane.
//
// xsimd's choose how they reduce the angle by all lanes together, so that a lane's bits depend on its neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include "raytrace/math/doubles.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// What lanes hold: float, or double in Doubles.
template <class F>
using LaneNumber = std::conditional_t<requires { &F::to_float; }, double, float>;

template <class F>
struct SineAndCosine {
  F sine, cosine;
};

namespace detail {

/// Taylor's coefficients in the square of the angle: of the sine over the angle (first_factor 2), of the cosine (1).
template <std::size_t terms>
constexpr std::array<double, terms> alternating_coefficients(int first_factor) {
  std::array<double, terms> coefficients{};
  double coefficient = 1, factor = first_factor;
  for (double& c : coefficients) {
    c = coefficient;
    coefficient /= -factor * (factor + 1);
    factor += 2;
  }
  return coefficients;
}

template <class F, std::size_t terms>
RAYTRACE_INLINE F polynomial(const std::array<double, terms>& coefficients, const F& x) {
  F sum(static_cast<LaneNumber<F>>(coefficients[terms - 1]));
  for (std::size_t i = terms - 1; i-- > 0;) sum = multiply_add(sum, x, F(static_cast<LaneNumber<F>>(coefficients[i])));
  return sum;
}

}  // namespace detail

/// Of `turns` times 2 pi; up to a million turns. F: floats, or Doubles of them, as precise as they are.
template <class F>
SineAndCosine<F> sin_cos_of_turns(const F& turns) {
  using Number = LaneNumber<F>;
  constexpr bool in_double = std::is_same_v<Number, double>;
  constexpr std::size_t terms = in_double ? 10 : 6;
  static constexpr auto of_sine = detail::alternating_coefficients<terms>(2);
  static constexpr auto of_cosine = detail::alternating_coefficients<terms>(1);
  const auto number = [](double value) { return F(static_cast<Number>(value)); };

  // All of this is exact: without whole turns, then in the first quarter of one, then in its nearer half.
  const F to_whole = number(in_double ? 0x1.8p52 : 0x1.8p23);
  const F rest = turns - ((turns + to_whole) - to_whole);
  const F size = abs(rest), quarter = min(size, number(0.5) - size);
  const F angle = min(quarter, number(0.25) - quarter) * number(2 * std::numbers::pi), square = angle * angle;
  const F sine = angle * detail::polynomial(of_sine, square), cosine = detail::polynomial(of_cosine, square);
  const auto steep = quarter > number(0.125);
  const F up = select(steep, cosine, sine), right = select(steep, sine, cosine);
  return {select(rest < number(0), -up, up), select(size > number(0.25), -right, right)};
}

}  // namespace raytrace
