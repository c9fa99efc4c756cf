// Radiance of each pixel of a film, or a part of it: sums in the film's units, exact, so that they do not depend on the
// order in which they are added, nor on the thread, tile or machine that adds them.
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

/// Red, green and blue of a pixel, in a film's units.
using RadianceSum = std::array<Int128, 3>;

class RadianceLayer {
 public:
  /// All zero. Throws std::bad_alloc.
  explicit RadianceLayer(const Region& region);

  /// Threads may add to the same pixel at the same time. x, y: in the whole picture, inside the region.
  void add(int x, int y, const RadianceSum& units);
  RadianceSum sum(int x, int y) const;

  /// Whether any sum needs more than 64 bits.
  bool has_high() const;
  void add_to(ContentHash& hash) const;

  const Region& region() const { return region_; }

 private:
  using Low = std::array<std::int64_t, 3>;

  Region region_;
  LargeArray<Low> sums_;
  LateArray<Low> highs_;  ///< in units 2^64 times theirs
};

}  // namespace raytrace
