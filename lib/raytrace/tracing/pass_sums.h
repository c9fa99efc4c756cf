// The sums of a block's samples by passes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "raytrace/tracing/block_sums.h"
#include "raytrace/tracing/light_layers.h"
#include "raytrace/tracing/light_parts.h"

namespace raytrace {

/// Each pass is rounded to the film's unit by itself, so that they add up to the picture but for that.
template <class Block>
class PassSums {
 public:
  /// layers: of a film; of null ones there are no sums.
  PassSums(const SumScale& scale, const PassLayers& layers) : layers_(layers) {
    for (std::size_t i = 0; i < layers_.size(); ++i)
      if (layers_[i] != nullptr) sums_[i].emplace(scale);
  }

  /// Adds a sample of each lane of `wanted`. refused: the lanes, as bits, that the picture has as black.
  [[gnu::noinline]] void add(const PassLight& light, const MaskN& wanted, std::uint32_t refused) {
    const MaskN lanes = refused == 0 ? wanted : wanted & !lanes_of(refused);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      if (!sums_[i]) continue;
      const MaskN large = sums_[i]->add_light(light[i], lanes);
      if (any(large)) sums_[i]->add_large(light[i], large);
    }
    if (++packets_ % BlockSums<Block>::most_packets == 0)
      for (auto& sums : sums_)
        if (sums) sums->carry();
  }

  void add_to_layers(const Block& block, const Region& region) const {
    for (std::size_t i = 0; i < sums_.size(); ++i)
      if (sums_[i]) sums_[i]->add_to(*layers_[i]->samples, block, region);
  }

 private:
  static MaskN lanes_of(std::uint32_t bits) {
    alignas(64) std::array<std::uint32_t, packet_lanes> lanes{};
    for (std::size_t i = 0; i < packet_lanes; ++i) lanes[i] = bits >> i & 1U;
    return float_mask<FloatN>(UintN::load_aligned(lanes.data()) != UintN(0u));
  }

  PassLayers layers_;
  std::array<std::optional<BlockSums<Block>>, light_pass_count> sums_;
  int packets_ = 0;
};

}  // namespace raytrace
