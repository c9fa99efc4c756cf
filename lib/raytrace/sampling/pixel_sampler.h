// The samples of the rays of a packet.
#pragma once

#include <bit>

#include "raytrace/math/simd.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/sobol_sequence.h"

namespace raytrace {

/// Which samples the lanes of a packet are: of each group of `size` samples of a pixel, a power of two, a lane has
/// number `slot`, below that.
class SampleGroup {
 public:
  SampleGroup(const UintN& slot, int size) : size_bits_(std::countr_zero(static_cast<unsigned>(size))) {
    SobolSequence::move_on(slot, size_bits_, x_, y_);
  }

 private:
  friend class PixelSampler;
  int size_bits_;
  UintN x_ = UintN(0u), y_ = UintN(0u);  ///< digits of a lane's points in which they differ from their group's first
};

/// Points in the unit square of each lane's pixel, for the pixel's samples in order. They depend on the pixel, the seed
/// and the sample's index alone.
class PixelSampler {
 public:
  struct Point {
    FloatN x, y;  ///< in [0, 1)
  };

  /// column, row: of the lanes' pixels, in the whole picture: each lane's in UintN, or std::uint32_t where all lanes
  /// have the same. first: the index of the first group's first sample, a multiple of the group's size. centered: all
  /// samples are the pixel's center instead, as a picture of a single sample wants it.
  template <class Uints>
  PixelSampler(const Uints& column, const Uints& row, const SampleGroup& group, std::uint64_t seed, std::uint32_t first,
               bool centered)
      : sequence_(first), group_bits_(group.size_bits_), centered_(centered) {
    if (centered) return;
    const Uints x =
        hash(column, row, Uints(static_cast<std::uint32_t>(seed)), Uints(static_cast<std::uint32_t>(seed >> 32)));
    const Uints y = mix_bits(x + Uints(0x9e3779b9u));
    shift_x_ = UintN(x) ^ group.x_;
    shift_y_ = UintN(y) ^ group.y_;
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
  UintN shift_x_ = UintN(0u), shift_y_ = UintN(0u);
  bool centered_;
};

}  // namespace raytrace
