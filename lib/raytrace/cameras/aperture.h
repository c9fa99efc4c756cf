// Where rays leave a lens.
#pragma once

#include <cmath>
#include <numbers>

#include "raytrace/math/simd.h"
#include "raytrace/math/turns.h"
#include "raytrace/math/unit_disk.h"

namespace raytrace {

/// A disk, or a regular polygon with its corners on that circle.
class Aperture {
 public:
  using Point = DiskPoint<FloatN>;  ///< to the right and up, in multiples of the radius

  /// blades: the number of corners, 0 for a disk. rotation: degrees from the right towards the top at which the first
  /// is.
  Aperture(int blades, double rotation)
      : blades_(static_cast<float>(blades)),
        rotation_(static_cast<float>(std::remainder(rotation, 360.0) / 360)),
        corner_x_(static_cast<float>(blades == 0 ? 0 : std::cos(2 * std::numbers::pi / blades))),
        corner_y_(static_cast<float>(blades == 0 ? 0 : std::sin(2 * std::numbers::pi / blades))) {}

  /// The point for (u1, u2) of the unit square: equal areas for equal areas.
  Point point(const FloatN& u1, const FloatN& u2) const {
    return blades_ == 0 ? on_unit_disk(u1, u2) : on_polygon(u1, u2);
  }

 private:
  /// Triangles about the middle, one for each side.
  Point on_polygon(const FloatN& u1, const FloatN& u2) const {
    const FloatN scaled = u1 * FloatN(blades_);
    const FloatN side = min(to_float(to_int(scaled)), FloatN(blades_ - 1));
    // Of the first one, whose corners are the middle, (1, 0) and `corner`.
    const FloatN outwards = sqrt(scaled - side), across = outwards * u2, along = outwards - across;
    const FloatN x = along + across * FloatN(corner_x_), y = across * FloatN(corner_y_);
    const auto [sine, cosine] = sin_cos_of_turns(side / FloatN(blades_) + FloatN(rotation_));
    return {x * cosine - y * sine, x * sine + y * cosine};
  }

  float blades_, rotation_;    ///< rotation_: in turns
  float corner_x_, corner_y_;  ///< the second corner, if the first is (1, 0)
};

}  // namespace raytrace
