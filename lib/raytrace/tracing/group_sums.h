// The sums of a block's samples by light groups.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "raytrace/film/light_layer.h"
#include "raytrace/tracing/block_sums.h"

namespace raytrace {

/// The light of all groups together, of which there is at least one.
inline Rgb<FloatN> light_of_all(std::span<const Rgb<FloatN>> groups) {
  Rgb<FloatN> light = groups.front();
  for (const Rgb<FloatN>& group : groups.subspan(1)) light += group;
  return light;
}

/// The first group's is that light, and the others' is none.
inline void set_light_of_no_group(std::span<Rgb<FloatN>> groups, const Rgb<FloatN>& light) {
  std::ranges::fill(groups, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
  groups.front() = light;
}

/// The picture's sums are those of all groups together: each group's light is rounded by itself, so that they add up
/// exactly.
template <class Block>
class GroupSums {
 public:
  GroupSums(const SumScale& scale, std::size_t groups) {
    sums_.reserve(groups);
    for (std::size_t i = 0; i < groups; ++i) sums_.emplace_back(scale);
  }

  /// Adds a sample of each lane of `wanted`, which met something in those of `hit`. light: each group's, all of it. The
  /// result: the lanes, as bits, some of whose light cannot be added.
  std::uint32_t add(std::span<const Rgb<FloatN>> light, const MaskN& hit, const MaskN& wanted) {
    std::uint32_t refused = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const MaskN large = i == 0 ? sums_[i].add({light[i], hit}, wanted) : sums_[i].add_light(light[i], wanted);
      if (any(large)) refused |= sums_[i].add_large(light[i], large);
    }
    if (++packets_ % BlockSums<Block>::most_packets == 0)
      for (BlockSums<Block>& sums : sums_) sums.carry();
    return refused;
  }

  /// layers: of each group, null where there is none.
  void add_to(Film& film, std::span<LightLayer* const> layers, const Block& block, const Region& region) const {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      sums_[i].add_to(film, block, region);
      if (layers[i] != nullptr) sums_[i].add_to(*layers[i]->samples, block, region);
    }
  }

 private:
  std::vector<BlockSums<Block>> sums_;
  int packets_ = 0;
};

}  // namespace raytrace
