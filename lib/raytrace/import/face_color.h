// Solid things that are clear, whose files say what comes through the whole.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/math/color.h"

namespace raytrace {

/// What each of the two faces lets through that light goes through.
inline Rgb<double> color_of_one_face(const Rgb<double>& through) {
  const auto root = [](double share) { return std::sqrt(std::max(share, 0.0)); };
  return {root(through.red), root(through.green), root(through.blue)};
}

}  // namespace raytrace
