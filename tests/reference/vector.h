// Numbers and vectors of the reference renderer.
#pragma once

#include <cmath>

namespace reference {

/// The widest hardware type: 64 bits of mantissa on x86, so that 1e-3 sized shapes at 1e4 from the origin, and tubes
/// 10,000 times thinner than their torus, still leave nine digits and more. Where it is plain double, fewer remain.
using Real = long double;

inline constexpr Real pi = 3.14159265358979323846264338327950288L;

struct Vector {
  Real x = 0, y = 0, z = 0;
  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator-(Vector a) { return {-a.x, -a.y, -a.z}; }
  friend Vector operator*(Real s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};

inline Real dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length(Vector a) { return std::sqrt(dot(a, a)); }
inline Vector unit(Vector a) { return 1 / length(a) * a; }

/// A unit vector at right angles to the unit vector a.
inline Vector perpendicular(Vector a) {
  const Vector other = std::fabs(a.x) < 0.6L ? Vector{1, 0, 0} : Vector{0, 1, 0};
  return unit(cross(a, other));
}

struct Ray {
  Vector origin;
  Vector direction;  ///< of any length but 0; distances count in multiples of it
  Vector at(Real t) const { return origin + t * direction; }
};

}  // namespace reference
