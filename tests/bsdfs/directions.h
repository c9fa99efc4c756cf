// Directions in double precision, for holding the BRDFs against formulas.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "raytrace/math/vec3.h"

namespace raytrace::test {

/// Right angles about an axis, by another construction than the library's.
struct Frame {
  Vec3d u, v, w;

  explicit Frame(const Vec3d& axis) : w(normalize(axis)) {
    const Vec3d other = std::abs(w.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    u = normalize(cross(other, w));
    v = cross(w, u);
  }

  /// The unit vector whose angle from the axis has this cosine, turned about it by `azimuth`.
  Vec3d direction(double cosine, double azimuth) const {
    const double sine = std::sqrt(std::fmax(0.0, 1 - cosine * cosine));
    return u * (sine * std::cos(azimuth)) + v * (sine * std::sin(azimuth)) + w * cosine;
  }

  double azimuth_of(const Vec3d& direction) const {
    const double angle = std::atan2(dot(direction, v), dot(direction, u));
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
  }
};

inline Vec3d mirror_of(const Vec3d& w, const Vec3d& normal) { return normal * (2 * dot(normal, w)) - w; }

/// Numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  /// In [0, 1), a float without rounding.
  double unit() { return static_cast<double>(bits_() >> 8) * 0x1p-24; }
  Vec3d direction() { return Frame({0, 0, 1}).direction(2 * unit() - 1, 2 * std::numbers::pi * unit()); }

 private:
  std::mt19937 bits_;
};

/// A direction at this angle from the normal.
inline Vec3d at_angle(const Vec3d& normal, double degrees, double azimuth) {
  return Frame(normal).direction(std::cos(degrees * std::numbers::pi / 180), azimuth);
}

}  // namespace raytrace::test
