#include "raytrace/film/radiance_layer.h"

#include <algorithm>

#include "raytrace/math/content_hash.h"

namespace raytrace {

RadianceLayer::RadianceLayer(const Region& region) : region_(region), sums_(LargeArray<Low>::zeros(region.pixels())) {}

void RadianceLayer::add(int x, int y, const RadianceSum& units) {
  const std::uint64_t at = region_.index(x, y);
  for (std::size_t channel = 0; channel < units.size(); ++channel) {
    const Limbs limbs = limbs_of(units[channel]);
    const std::int64_t before =
        std::atomic_ref(sums_[at][channel]).fetch_add(limbs.low, std::memory_order_relaxed);  // wraps around
    // What one addition carries depends on what it found; all that they carry together does not.
    std::int64_t sum = 0, carried = limbs.high;
    if (__builtin_add_overflow(before, limbs.low, &sum)) carried += before < 0 ? -1 : 1;
    if (carried != 0) [[unlikely]]
      std::atomic_ref(highs_.make(region_.pixels())[at][channel]).fetch_add(carried, std::memory_order_relaxed);
  }
}

RadianceSum RadianceLayer::sum(int x, int y) const {
  const std::uint64_t at = region_.index(x, y);
  const Low& low = sums_[at];
  const Low high = highs_.data() == nullptr ? Low{} : highs_.data()[at];
  RadianceSum sum;
  for (std::size_t channel = 0; channel < sum.size(); ++channel)
    sum[channel] = from_limbs({low[channel], high[channel]});
  return sum;
}

bool RadianceLayer::has_high() const {
  const Low* const highs = highs_.data();
  return highs != nullptr &&
         std::any_of(highs, highs + region_.pixels(), [](const Low& high) { return high != Low{}; });
}

void RadianceLayer::add_to(ContentHash& hash) const {
  hash.add(sums_.data(), region_.pixels() * sizeof(Low));
  if (has_high()) hash.add(highs_.data(), region_.pixels() * sizeof(Low));
}

}  // namespace raytrace
