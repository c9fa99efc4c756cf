// Three-component vectors for points, directions and normals.
//
// T is a scalar (float, double) or a SIMD batch (see math/simd.h); the same formula serves both.
#pragma once

#include <cmath>

#include "raytrace/math/inline.h"

namespace raytrace {

template <class T>
struct Vec3 {
  T x, y, z;  // not set by default: packets of them stand in the innermost loop

  Vec3() = default;
  constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}

  /// Converts between component types, or spreads a scalar vector over all lanes of a batch.
  template <class U>
  explicit constexpr Vec3(const Vec3<U>& other)
      : x(static_cast<T>(other.x)), y(static_cast<T>(other.y)), z(static_cast<T>(other.z)) {}

  Vec3& operator+=(const Vec3& b) { return *this = *this + b; }

  friend RAYTRACE_INLINE Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend RAYTRACE_INLINE Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend RAYTRACE_INLINE Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend RAYTRACE_INLINE Vec3 operator*(const Vec3& a, const T& s) { return {a.x * s, a.y * s, a.z * s}; }
  friend RAYTRACE_INLINE Vec3 operator*(const T& s, const Vec3& a) { return a * s; }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class T>
RAYTRACE_INLINE T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
RAYTRACE_INLINE Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// By number: x, y and z are 0, 1 and 2.
template <class T>
RAYTRACE_INLINE const T& component(const Vec3<T>& a, int number) {
  return number == 0 ? a.x : number == 1 ? a.y : a.z;
}
template <class T>
RAYTRACE_INLINE T& component(Vec3<T>& a, int number) {
  return number == 0 ? a.x : number == 1 ? a.y : a.z;
}

/// The largest of the components' magnitudes.
template <class T>
RAYTRACE_INLINE T largest_component(const Vec3<T>& a) {
  return max(max(abs(a.x), abs(a.y)), abs(a.z));
}

/// Length. Components beyond 1e18 (float) overflow: the scene format refuses them.
template <class T>
RAYTRACE_INLINE T length(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// Lane by lane: a where the mask is true, else b.
template <class T, class Mask>
RAYTRACE_INLINE Vec3<T> select(const Mask& mask, const Vec3<T>& a, const Vec3<T>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// Unit vector of the same direction; a must not be zero.
template <class T>
RAYTRACE_INLINE Vec3<T> normalize(const Vec3<T>& a) {
  return a * (T(1) / length(a));
}

}  // namespace raytrace
