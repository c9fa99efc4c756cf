// The samples of the rays of a packet.
#pragma once

#include <bit>

#include "raytrace/math/simd.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/sobol_sequence.h"

namespace raytrace {

/// Points in the unit square of each lane's pixel, for the pixel's samples in order. They depend on the pixel, the seed
/// and the sample's index alone.
class PixelSampler {
 public:
  struct Point {
    FloatN x, y;  ///< in [0, 1)
  };

  /// column, row: of the lanes' pixels, in the whole picture. Of each group of `group` samples (a power of two) a lane
  /// has number `slot`, below that. first: the index of the first group's first sample, a multiple of `group`.
  /// centered: all samples are the pixel's center instead, as a picture of a single sample wants it.
  PixelSampler(const UintN& column, const UintN& row, const UintN& slot, int group, std::uint64_t seed,
               std::uint32_t first, bool centered)
      : sequence_(first), group_bits_(std::countr_zero(static_cast<unsigned>(group))), centered_(centered) {
    const UintN low(static_cast<std::uint32_t>(seed)), high(static_cast<std::uint32_t>(seed >> 32));
    shift_x_ = hash(column, row, low, high);
    shift_y_ = mix_bits(shift_x_ + UintN(0x9e3779b9u));
    SobolSequence::move_on(slot, group_bits_, shift_x_, shift_y_);
  }

  /// The next group's.
  Point next() {
    if (centered_) return {FloatN(0.5f), FloatN(0.5f)};
    const SobolSequence::Point point = sequence_.point();
    sequence_.advance(group_bits_);
    return {to_unit(UintN(point.x) ^ shift_x_), to_unit(UintN(point.y) ^ shift_y_)};
  }

 private:
  /// The 24 leading bits as a fraction: every float of the result is exact and below 1.
  static FloatN to_unit(const UintN& bits) { return to_float(same_bits<IntN>(bits >> 8)) * FloatN(0x1p-24f); }

  SobolSequence sequence_;
  int group_bits_;
  UintN shift_x_, shift_y_;
  bool centered_;
};

}  // namespace raytrace
