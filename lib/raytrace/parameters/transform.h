// How objects are moved, turned and scaled.
//
//   <transform> <scale x="2" y="2" z="2"/> <rotate x="0" y="1" z="0" angle="30"/> <translate x="5" y="0" z="0"/>
//   </transform>
//
// The steps are applied in their order.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <vector>

#include "raytrace/math/affine.h"

namespace raytrace {

struct TransformStep {
  enum Type { translate, rotate, scale, matrix };
  static constexpr std::array<std::string_view, 4> elements = {"translate", "rotate", "scale", "matrix"};

  Type type = translate;
  /// x, y, z; of rotate: x, y, z of the axis, then the angle in degrees, counter-clockwise if the axis points at the
  /// viewer; of matrix: row by row, for column vectors, the last row being 0 0 0 1.
  std::array<double, 16> values{};

  std::size_t value_count() const { return type == matrix ? 16 : type == rotate ? 4 : 3; }

  Affine affine() const {
    const auto& v = values;
    switch (type) {
      case translate:
        return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {v[0], v[1], v[2]}};
      case scale:
        return {{v[0], 0, 0}, {0, v[1], 0}, {0, 0, v[2]}, {0, 0, 0}};
      case rotate:
        return rotation(normalize(Vec3d(v[0], v[1], v[2])), v[3]);
      case matrix:
        break;
    }
    return {{v[0], v[4], v[8]}, {v[1], v[5], v[9]}, {v[2], v[6], v[10]}, {v[3], v[7], v[11]}};
  }

  friend bool operator==(const TransformStep&, const TransformStep&) = default;

 private:
  /// Rodrigues' formula.
  static Affine rotation(const Vec3d& axis, double degrees) {
    const double angle = std::remainder(degrees, 360), radians = angle * (std::numbers::pi / 180);
    // Right angles are exact.
    const double cosine = std::abs(angle) == 90 ? 0 : std::cos(radians);
    const double sine = std::abs(angle) == 180 ? 0 : std::sin(radians);
    const auto turned = [&](const Vec3d& v) {
      return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1 - cosine));
    };
    return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {0, 0, 0}};
  }
};

/// Without steps, the identity.
struct Transform {
  std::vector<TransformStep> steps;

  bool empty() const { return steps.empty(); }
  Affine affine() const {
    Affine all;
    for (const TransformStep& step : steps) all = step.affine() * all;
    return all;
  }
  friend bool operator==(const Transform&, const Transform&) = default;
};

}  // namespace raytrace
