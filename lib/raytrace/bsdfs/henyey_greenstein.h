// Henyey and Greenstein's phase function: where light goes that is scattered inside of a medium (pbrt-v4, section
// 11.3). Its anisotropy g is the mean cosine between the ways before and after: 0 scatters evenly to all sides. T: a
// batch; g within 0.98 of 0.
#pragma once

#include <numbers>

#include "raytrace/bsdfs/direction_about.h"

namespace raytrace {

/// Its value, which is also the density per solid angle at which sample_henyey_greenstein() draws. cosine: between both
/// ways.
template <class T>
T henyey_greenstein(const T& cosine, const T& g) {
  const T base = max(T(1) + g * g - T(2) * g * cosine, T(1e-6F));
  return T(std::numbers::inv_pi_v<float> / 4) * (T(1) - g * g) / (base * sqrt(base));
}

/// A way after a scattering, of unit length, drawn out of numbers in [0, 1).
template <class T>
Vec3<T> sample_henyey_greenstein(const Vec3<T>& direction, const T& anisotropy, const T& u1, const T& u2) {
  const Mask<T> is_even = abs(anisotropy) < T(1e-3F);
  const T g = select(is_even, T(1), anisotropy);
  const T part = (T(1) - g * g) / (T(1) - g + T(2) * g * u1);
  const T of_lobe = (T(1) + g * g - part * part) / (T(2) * g);
  const T cosine = select(is_even, T(1) - T(2) * u1, min(max(of_lobe, T(-1)), T(1)));
  const T sine = sqrt(max(T(1) - cosine * cosine, T(0)));
  return normalize(direction_about(direction, cosine, sine, u2));
}

}  // namespace raytrace
