// Colours with alpha, as textures have them.
#pragma once

#include "raytrace/math/color.h"

namespace raytrace {

/// Alpha does not multiply the colour.
template <class T>
struct Rgba {
  Rgb<T> color;
  T alpha;
};

template <class T, class Mask>
RAYTRACE_INLINE Rgba<T> select(const Mask& mask, const Rgba<T>& a, const Rgba<T>& b) {
  return {select(mask, a.color, b.color), select(mask, a.alpha, b.alpha)};
}

/// All four numbers times scale, plus offset.
template <class T>
RAYTRACE_INLINE Rgba<T> scaled(const Rgba<T>& value, float scale, float offset) {
  const auto changed = [&](const T& x) { return x * T(scale) + T(offset); };
  return {{changed(value.color.red), changed(value.color.green), changed(value.color.blue)}, changed(value.alpha)};
}

/// a where s is 0, b where it is 1; exactly a where both are the same.
template <class T>
RAYTRACE_INLINE T mix(const T& a, const T& b, const T& s) {
  return multiply_add(b - a, s, a);
}
template <class T>
RAYTRACE_INLINE Rgb<T> mix(const Rgb<T>& a, const Rgb<T>& b, const T& s) {
  return {mix(a.red, b.red, s), mix(a.green, b.green, s), mix(a.blue, b.blue, s)};
}
template <class T>
RAYTRACE_INLINE Rgba<T> mix(const Rgba<T>& a, const Rgba<T>& b, const T& s) {
  return {mix(a.color, b.color, s), mix(a.alpha, b.alpha, s)};
}

}  // namespace raytrace
