// Values that change from frame to frame: what they are between their keys.
//
// Before the first key and after the last one a value is held. Between two keys each component goes monotonically from
// the one's to the other's, so it never leaves the range of its keys. A linear key is a corner: what comes to it and
// what leaves it goes straight for it. A smooth key is passed without a corner; the first and the last key, if smooth,
// are left and reached with speed 0, as is a key whose neighbours are both above or both below it.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "raytrace/description/parse_value.h"

namespace raytrace {

enum class Interpolation { linear, smooth };

/// "linear" or "smooth".
DiagnosticText parse_interpolation(std::string_view text, Interpolation& interpolation);

struct Key {
  double frame = 0;
  std::array<double, 3> components{};  ///< a number's is the first
  Interpolation interpolation = Interpolation::linear;
};

/// Keys nearer to each other than this are of the same frame.
inline constexpr double least_key_distance = 1e-6;

/// keys: at least one, ordered by their frames, which differ by least_key_distance or more.
///
/// Cubic Hermite interpolation. At a smooth key the slope is the weighted harmonic mean of those of the lines to its
/// neighbours, or 0 (Fritsch, Butland: A Method for Constructing Local Monotone Piecewise Cubic Interpolants, 1984); at
/// a linear key it is on each side that of the line.
std::array<double, 3> value_at(const std::vector<Key>& keys, double frame);

}  // namespace raytrace
