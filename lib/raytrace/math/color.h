// Linear RGB triples: reflectances and radiances.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/math/inline.h"

namespace raytrace {

/// T is a scalar or a SIMD batch. Linear light, sRGB/Rec.709 primaries, no unit clamp.
template <class T>
struct Rgb {
  T red, green, blue;  // not set by default, as in Vec3

  Rgb() = default;
  constexpr Rgb(T red_, T green_, T blue_) : red(red_), green(green_), blue(blue_) {}
  template <class U>
  explicit constexpr Rgb(const Rgb<U>& other)
      : red(static_cast<T>(other.red)), green(static_cast<T>(other.green)), blue(static_cast<T>(other.blue)) {}

  Rgb& operator+=(const Rgb& b) { return *this = *this + b; }

  friend RAYTRACE_INLINE Rgb operator+(const Rgb& a, const Rgb& b) {
    return {a.red + b.red, a.green + b.green, a.blue + b.blue};
  }
  friend RAYTRACE_INLINE Rgb operator-(const Rgb& a, const Rgb& b) {
    return {a.red - b.red, a.green - b.green, a.blue - b.blue};
  }
  friend RAYTRACE_INLINE Rgb operator*(const Rgb& a, const Rgb& b) {
    return {a.red * b.red, a.green * b.green, a.blue * b.blue};
  }
  friend RAYTRACE_INLINE Rgb operator/(const Rgb& a, const Rgb& b) {
    return {a.red / b.red, a.green / b.green, a.blue / b.blue};
  }
  friend RAYTRACE_INLINE Rgb operator*(const Rgb& a, const T& s) { return {a.red * s, a.green * s, a.blue * s}; }
};

/// The larger of both in each channel.
inline Rgb<float> max(const Rgb<float>& a, const Rgb<float>& b) {
  return {std::max(a.red, b.red), std::max(a.green, b.green), std::max(a.blue, b.blue)};
}

/// Each channel's magnitude.
inline Rgb<float> abs(const Rgb<float>& a) { return {std::abs(a.red), std::abs(a.green), std::abs(a.blue)}; }

/// a - b in each channel, or 0 where b is larger.
template <class T>
RAYTRACE_INLINE Rgb<T> saturating_difference(const Rgb<T>& a, const Rgb<T>& b) {
  return {max(a.red - b.red, T(0)), max(a.green - b.green, T(0)), max(a.blue - b.blue, T(0))};
}

/// Lane by lane: a where the mask is true, else b.
template <class T, class Mask>
RAYTRACE_INLINE Rgb<T> select(const Mask& mask, const Rgb<T>& a, const Rgb<T>& b) {
  return {select(mask, a.red, b.red), select(mask, a.green, b.green), select(mask, a.blue, b.blue)};
}

}  // namespace raytrace
