// What smooth boundaries reflect of unpolarised light: by Fresnel's equations between clear media, and off metals.
#pragma once

#include "raytrace/math/vec3.h"

namespace raytrace {

/// T: a batch.
template <class T>
struct FresnelReflection {
  T reflectance;         ///< the share of light that is reflected; the rest comes through
  T transmitted_cosine;  ///< of its angle with the normal on the other side; 0 where nothing comes through
};

/// cosine: of the light's angle with the normal on its side, in [0, 1]. eta: the index of refraction on the other side
/// over that on the light's.
template <class T>
FresnelReflection<T> fresnel_reflection(const T& cosine, const T& eta) {
  const T squared_sine = max(T(1) - cosine * cosine, T(0)) / (eta * eta);
  const auto comes_through = squared_sine < T(1);
  const T transmitted = sqrt(max(T(1) - squared_sine, T(0)));
  const T across = (cosine - eta * transmitted) / (cosine + eta * transmitted);
  const T along = (eta * cosine - transmitted) / (eta * cosine + transmitted);
  return {select(comes_through, (across * across + along * along) * T(0.5F), T(1)), transmitted};
}

/// Metals reflect about as Schlick's approximation has it, but less at 82 degrees (OpenPBR's F82-tint; Kutz, Hasan and
/// Edmondson, "Novel Aspects of the Adobe Standard Material", 2021): at a cosine of c this times c (1 - c)^6 less, so
/// that edge multiplies what it is at a cosine of 1/7. normal: reflectance from straight above. T: float, or a batch.
template <class T>
T f82_dip(const T& normal, const T& edge) {
  constexpr float c = 1.0F / 7, rest = 1 - c, fifth = rest * rest * rest * rest * rest;
  return (normal + (T(1) - normal) * T(fifth)) * (T(1) - edge) * T(1 / (c * fifth * rest));
}

/// What a metal reflects at an angle of that cosine. T: a batch.
template <class T>
T f82_reflectance(const T& normal, const T& edge, const T& cosine) {
  const T rest = T(1) - min(cosine, T(1)), fifth = (rest * rest) * (rest * rest) * rest;
  return normal + (T(1) - normal) * fifth - f82_dip(normal, edge) * (cosine * fifth * rest);
}

/// Of a pane between two such boundaries, without a distance between them, light going to and fro in it: R + T^2 R (1 +
/// R^2 + R^4...). reflectance: of one of them.
template <class T>
T pane_reflectance(const T& reflectance) {
  return T(2) * reflectance / (T(1) + reflectance);
}

}  // namespace raytrace
