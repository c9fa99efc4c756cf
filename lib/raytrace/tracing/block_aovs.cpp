#include "raytrace/tracing/block_aovs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "raytrace/math/lanes.h"

namespace raytrace {

void BlockAovs::prepare() {
  nearest_.fill(FloatN(0));
  const std::vector<int>& units = film_.settings().mean_units;
  for (std::size_t i = 0; i < units.size(); ++i) {
    means_[i].units = std::ldexp(1.0, -units[i]);
    means_[i].largest = FloatN(static_cast<float>(std::min(std::ldexp(FixedPointSums<FloatN>::largest_term, units[i]),
                                                           double{std::numeric_limits<float>::max()})));
  }
}

void BlockAovs::add(const AovInputs& seen, const MaskN& wanted, const UintN& sample, bool followed_apart) {
  const MaskN hit = seen.hit() & wanted;
  if (none(hit)) return;
  const MaskN nearer = hit & (seen.depth() < depth_);
  depth_ = select(nearer, seen.depth(), depth_);
  sample_ = select_lanes(nearer, same_bits<IntN>(sample), sample_);

  NextValues next;
  [&]<std::size_t... aov>(std::index_sequence<aov...>) {
    (add_values<aov>(seen, hit, nearer, followed_apart, next), ...);
  }(std::make_index_sequence<std::size(aov_table)>());
}

void BlockAovs::add_followed(const FollowedSurface& surface, const MaskN& wanted) {
  std::size_t next_mean = 0;
  const auto add_values_of = [&]<std::size_t aov>(std::integral_constant<std::size_t, aov>) {
    if (!film_.settings().wanted.has(aov)) return;
    if constexpr (aov_table[aov].follows_mirrors) {
      std::size_t mean = next_mean;
      for (const FloatN& value : followed_values<aov>(surface)) add_to_mean(mean++, wanted, value);
    }
    if constexpr (aov_table[aov].rule == AovRule::mean) next_mean += aov_table[aov].values();
  };
  [&]<std::size_t... aov>(std::index_sequence<aov...>) {
    (add_values_of(std::integral_constant<std::size_t, aov>()), ...);
  }(std::make_index_sequence<std::size(aov_table)>());
}

void BlockAovs::add_to_mean(std::size_t mean, const MaskN& lanes, const FloatN& value) {
  Mean& to = means_[mean];
  const MaskN counts = lanes & (abs(value) <= to.largest);  // false for NaN
  to.sum.add(select(counts, value, FloatN(0)), to.units);
}

template <std::size_t aov>
void BlockAovs::add_values(const AovInputs& seen, const MaskN& hit, const MaskN& nearer, bool followed_apart,
                           NextValues& next) {
  if (!film_.settings().wanted.has(aov)) return;
  constexpr AovRule rule = aov_table[aov].rule;
  if constexpr (rule == AovRule::nearest) {
    for (const FloatN& value : aov_values<aov>(seen)) {
      FloatN& kept = nearest_[next.nearest++];
      kept = select(nearer, value, kept);
    }
  } else if constexpr (rule == AovRule::mean) {
    if (aov_table[aov].follows_mirrors && followed_apart) {
      next.mean += aov_table[aov].values();
      return;
    }
    for (const FloatN& value : aov_values<aov>(seen)) add_to_mean(next.mean++, hit, value);
  } else if constexpr (rule == AovRule::coverage) {
    count(next.coverage++, select_lanes(hit, aov_values<aov>(seen), IntN(nothing)));
  }
}

void BlockAovs::count(std::size_t coverage, const IntN& things) {
  Run& run = runs_[coverage];
  const MaskN same = float_mask<FloatN>(things == run.thing);
  for (const std::size_t lane : SetLanes(!same)) end_run(coverage, lane);
  run.samples = select_lanes(same, run.samples + IntN(1), IntN(1));
  run.thing = things;
}

void BlockAovs::end_run(std::size_t coverage, std::size_t lane) {
  const std::int32_t thing = runs_[coverage].thing.get(lane);
  if (thing == nothing || (lanes_ >> lane & 1U) == 0) return;
  const std::vector<std::uint32_t>& ids = (*film_.settings().coverage_ids)[coverage];
  const auto samples = static_cast<std::uint32_t>(runs_[coverage].samples.get(lane));
  film_.add_coverage(x_[lane], y_[lane], coverage, {ids[static_cast<std::size_t>(thing)], samples});
}

void BlockAovs::finish() {
  const AovSettings& settings = film_.settings();
  for (std::size_t coverage = 0; coverage < settings.coverages; ++coverage)
    for (const std::size_t lane : SetLanes(lanes_)) end_run(coverage, lane);

  for (std::size_t i = 0; i < settings.mean_units.size(); ++i) {
    const auto sums = means_[i].sum.sums();
    for (const std::size_t lane : SetLanes(lanes_)) film_.add_mean(x_[lane], y_[lane], i, sums[lane]);
  }

  if (settings.nearest_values == 0) return;
  alignas(64) std::array<float, packet_lanes> lanes;
  std::array<std::array<std::uint32_t, all_values(AovRule::nearest)>, packet_lanes> values{};
  for (std::size_t i = 0; i < settings.nearest_values; ++i) {
    nearest_[i].store_aligned(lanes.data());
    for (std::size_t lane = 0; lane < packet_lanes; ++lane) values[lane][i] = std::bit_cast<std::uint32_t>(lanes[lane]);
  }
  depth_.store_aligned(lanes.data());
  const std::uint32_t met = bits_of<FloatN>(depth_ < infinity<FloatN>());
  for (const std::size_t lane : SetLanes(lanes_ & met)) {
    const auto sample = static_cast<std::uint32_t>(sample_.get(lane));
    film_.add_nearest(x_[lane], y_[lane], lanes[lane], sample, values[lane].data());
  }
}

}  // namespace raytrace
