// One of several candidates, drawn in proportion to their weights as they come (Chao, "A General Purpose Unequal
// Probability Sampling Plan", Biometrika 1982).
#pragma once

#include "raytrace/math/simd.h"

namespace raytrace {

/// Of each lane.
class Reservoir {
 public:
  /// u: in [0, 1).
  explicit Reservoir(const FloatN& u) : u_(u) {}

  /// The lanes in which the candidate of that weight takes the place of those before it. Weights that are not above 0
  /// or not finite are none.
  MaskN add(const FloatN& weight) {
    const MaskN counts = (weight > FloatN(0)) & (weight < infinity<FloatN>());
    const FloatN sum = total_ + weight, place = u_ * sum;
    const MaskN chosen = counts & (place < weight);
    const FloatN rest = select(chosen, place / weight, (place - weight) / total_);
    u_ = select(counts, min(max(rest, FloatN(0)), FloatN(0x1.fffffep-1F)), u_);
    total_ = select(counts, sum, total_);
    return chosen;
  }
  /// The sum of all weights.
  const FloatN& total() const { return total_; }

 private:
  FloatN u_;  ///< from 0 to 1, evenly, whatever has been chosen
  FloatN total_{0};
};

}  // namespace raytrace
