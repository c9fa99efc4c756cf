// The transfer curve of sRGB (IEC 61966-2-1), with which pictures of 8 bits are encoded.
#pragma once

#include <cmath>

namespace raytrace {

/// Of one channel, both from 0 to 1. T: float or double.
template <class T>
T linear_of_srgb(T code) {
  return code <= T(0.04045) ? code / T(12.92) : std::pow((code + T(0.055)) / T(1.055), T(2.4));
}

template <class T>
T srgb_of_linear(T light) {
  return light <= T(0.0031308) ? light * T(12.92) : T(1.055) * std::pow(light, T(1) / T(2.4)) - T(0.055);
}

}  // namespace raytrace
