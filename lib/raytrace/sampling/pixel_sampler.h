// The samples of the rays of a packet.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "raytrace/math/gather.h"
#include "raytrace/math/simd.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/pixel_filter.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/sampling/sobol_sequence.h"

namespace raytrace {

/// A hash of pixels, by their column and row in the whole picture.
template <class Uints>
RAYTRACE_INLINE Uints pixel_hash(const Uints& column, const Uints& row, std::uint64_t seed) {
  return hash(column, row, Uints(static_cast<std::uint32_t>(seed)), Uints(static_cast<std::uint32_t>(seed >> 32)));
}

/// Random digits of pixels, with which each shifts the sequence. Uints: std::uint32_t or a batch of them.
template <class Uints>
struct PixelScramble {
  Uints x, y;

  PixelScramble(const Uints& shift_x, const Uints& shift_y) : x(shift_x), y(shift_y) {}
  /// column, row: of the pixel, in the whole picture.
  PixelScramble(const Uints& column, const Uints& row, std::uint64_t seed)
      : x(pixel_hash(column, row, seed)), y(mix_bits(x + Uints(0x9e3779b9u))) {}
};

/// Those of one pixel after the other, made for a packet of neighbours at once.
class PixelScrambles {
 public:
  explicit PixelScrambles(std::uint64_t seed) : seed_(seed) {}

  PixelScramble<std::uint32_t> at(std::uint32_t column, std::uint32_t row) {
    const std::uint32_t place = column % packet_lanes, first = column - place;
    if (first != first_ || row != row_) make(first, row);
    return {x_[place], y_[place]};
  }

 private:
  void make(std::uint32_t first, std::uint32_t row) {
    const PixelScramble<UintN> shifts(UintN(first) + lane_numbers<UintN>(), UintN(row), seed_);
    shifts.x.store_aligned(x_.data());
    shifts.y.store_aligned(y_.data());
    first_ = first;
    row_ = row;
  }

  std::uint64_t seed_;
  std::uint32_t first_ = ~0U, row_ = ~0U;  ///< where those that it has begin
  alignas(64) std::array<std::uint32_t, packet_lanes> x_, y_;
};

/// Which samples the lanes of a packet are: of each group of `size` samples of a pixel, a power of two, a lane has
/// number `slot`, below that.
class SampleGroup {
 public:
  SampleGroup(const UintN& slot, int size) : size_bits_(std::countr_zero(static_cast<unsigned>(size))) {
    SobolSequence::offset_by(slot, size_bits_, x_, y_);
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
  using Point = Sample2D;

  /// shift: of the lanes' pixels, each lane's in UintN, or std::uint32_t where all lanes have the same. first: the
  /// index of the first group's first sample, a multiple of the group's size. centered: all samples are the pixel's
  /// center instead, as a picture of a single sample wants it.
  template <class Uints>
  PixelSampler(const PixelScramble<Uints>& shift, const SampleGroup& group, std::uint32_t first, bool centered)
      : sequence_(first),
        group_bits_(group.size_bits_),
        shift_x_(UintN(shift.x) ^ group.x_),
        shift_y_(UintN(shift.y) ^ group.y_),
        centered_(centered) {}

  /// The next group's.
  Point next() {
    if (centered_) return {FloatN(0.5f), FloatN(0.5f)};
    if (begun_) sequence_.advance(group_bits_);
    begun_ = true;
    const SobolSequence::Point point = sequence_.point();
    return {to_unit(UintN(point.x) ^ shift_x_), to_unit(UintN(point.y) ^ shift_y_)};
  }

 private:
  SobolSequence sequence_;
  int group_bits_;
  UintN shift_x_, shift_y_;
  bool centered_, begun_ = false;
};

/// A sample of the pixel's square as the filter places it: from the same corner, and perhaps beyond the square.
inline Sample2D filtered(const FilterTable& filter, const Sample2D& sample) {
  const auto along_axis = [&](const FloatN& u) {
    const FloatN share = abs(u * FloatN(2) - FloatN(1)) * FloatN(float{FilterTable::intervals});
    const IntN interval = min(to_int(share), IntN(std::int32_t{FilterTable::intervals} - 1));
    const FloatN low = gather(filter.distances(), interval), high = gather(filter.distances() + 1, interval);
    const FloatN distance = low + (high - low) * (share - to_float(interval));
    return FloatN(0.5f) + select(u < FloatN(0.5f), -distance, distance);
  };
  return {along_axis(sample.x), along_axis(sample.y)};
}

}  // namespace raytrace
