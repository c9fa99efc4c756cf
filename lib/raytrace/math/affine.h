// Affine maps of space, in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "raytrace/math/vec3.h"

namespace raytrace {

/// A point p goes to x p.x + y p.y + z p.z + origin: x, y and z are where the axes' unit vectors go.
struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  Vec3d vector(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d point(const Vec3d& p) const { return vector(p) + origin; }
  double determinant() const { return dot(x, cross(y, z)); }

  /// a * b: first b, then a.
  friend Affine operator*(const Affine& a, const Affine& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.origin)};
  }

  /// What turns normals: the transpose of the inverse of what turns vectors, times the determinant's sign so that a
  /// mirrored surface keeps its front. The determinant must not be 0. The length of the result means nothing.
  Vec3d normal(const Vec3d& n) const {
    const Vec3d turned = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return determinant() < 0 ? -turned : turned;
  }

  /// The determinant must not be 0.
  Affine inverse() const {
    const double scale = 1 / determinant();
    const Vec3d rows[] = {cross(y, z) * scale, cross(z, x) * scale, cross(x, y) * scale};
    Affine result;
    result.x = {rows[0].x, rows[1].x, rows[2].x};
    result.y = {rows[0].y, rows[1].y, rows[2].y};
    result.z = {rows[0].z, rows[1].z, rows[2].z};
    result.origin = -result.vector(origin);
    return result;
  }

  /// Whether it moves and scales alone, so that the axes keep their directions.
  bool keeps_axes() const {
    return x.x > 0 && x.y == 0 && x.z == 0 && y.x == 0 && y.y > 0 && y.z == 0 && z.x == 0 && z.y == 0 && z.z > 0;
  }
  bool is_identity() const { return keeps_axes() && x.x == 1 && y.y == 1 && z.z == 1 && length(origin) == 0; }

  /// Whether it turns and mirrors alone, but for what writing it with six digits rounds.
  bool is_turn() const {
    constexpr double rounding = 1e-5;
    const double length_error = std::max({std::abs(length(x) - 1), std::abs(length(y) - 1), std::abs(length(z) - 1)});
    const double skew = std::max({std::abs(dot(x, y)), std::abs(dot(y, z)), std::abs(dot(z, x))});
    return std::max(length_error, skew) <= rounding && length(origin) == 0;
  }

  /// By how much it scales all lengths, if it does so to all by the same: it turns, mirrors, moves and scales.
  std::optional<double> uniform_scale() const {
    const double longest = std::max({length(x), length(y), length(z)});
    const double rounding = 1e-13 * longest;
    const double skew = std::max({std::abs(dot(x, y)), std::abs(dot(y, z)), std::abs(dot(z, x))});
    const double shortest = std::min({length(x), length(y), length(z)});
    if (longest - shortest > rounding || skew > rounding * longest) return std::nullopt;
    return std::cbrt(std::abs(determinant()));
  }
};

}  // namespace raytrace
