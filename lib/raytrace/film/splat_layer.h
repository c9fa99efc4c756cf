// What light paths bring to a film: unlike a pixel's own samples, they reach any pixel.
//
// Sums in the film's units, exact, so that they do not depend on the order in which paths are traced, nor on which
// thread, tile or machine traces them.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "raytrace/film/region.h"
#include "raytrace/math/limbs.h"
#include "raytrace/memory/large_array.h"

namespace raytrace {

class ContentHash;

/// Radiance of a pixel, or a part of it, in a film's units.
using SplatSum = std::array<Int128, 3>;

class SplatLayer {
 public:
  /// All zero. region: of the film; picture_pixels: of the whole picture, which is how many light paths there are for
  /// each sample of a pixel. Throws std::bad_alloc.
  SplatLayer(const Region& region, std::uint64_t picture_pixels);

  /// Threads may add to the same pixel at the same time. x, y: in the whole picture, inside the region.
  void add(int x, int y, const SplatSum& units);
  SplatSum sum(int x, int y) const;

  /// Pixels of the region share all light paths among them, whatever part of the picture it is: pixel k of n, row by
  /// row, has those of the picture's pixels k, k + n, k + 2 n..., one for each of its samples. How many of them: in
  /// most films one.
  std::uint64_t paths_per_sample(int x, int y) const {
    const std::uint64_t first = number(x, y);
    return first < picture_pixels_ ? (picture_pixels_ - first - 1) / pixels() + 1 : 0;
  }
  /// The picture's pixel, counted row by row, that path i of those belongs to.
  std::uint64_t path_pixel(int x, int y, std::uint64_t i) const { return number(x, y) + i * pixels(); }

  /// Counts light paths, each with all that it brought.
  void add_paths(std::uint64_t paths) { paths_.fetch_add(paths, std::memory_order_relaxed); }
  /// How many samples of each pixel of the picture these are.
  double samples() const {
    return static_cast<double>(paths_.load(std::memory_order_relaxed)) / static_cast<double>(picture_pixels_);
  }

  /// Whether any sum needs more than 64 bits.
  bool has_high() const;
  void add_to(ContentHash& hash) const;

 private:
  using Low = std::array<std::int64_t, 3>;

  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(region_.width()) * static_cast<std::uint64_t>(region_.height());
  }
  std::uint64_t number(int x, int y) const {
    return static_cast<std::uint64_t>(y - region_.y0) * static_cast<std::uint64_t>(region_.width()) +
           static_cast<std::uint64_t>(x - region_.x0);
  }

  Region region_;
  std::uint64_t picture_pixels_;
  std::atomic<std::uint64_t> paths_{0};
  LargeArray<Low> sums_;
  LateArray<Low> highs_;  ///< in units 2^64 times theirs
};

}  // namespace raytrace
