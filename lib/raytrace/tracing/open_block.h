// Packets of camera rays whose paths are traced later, together with others, and the blocks of pixels that they are of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "raytrace/tracing/block_aovs.h"
#include "raytrace/tracing/block_error.h"
#include "raytrace/tracing/block_sums.h"
#include "raytrace/tracing/group_sums.h"
#include "raytrace/tracing/pass_sums.h"
#include "raytrace/tracing/ray_result.h"

namespace raytrace {

template <class Block>
struct WaitingPacket {
  Block block;
  std::uint32_t base;         ///< of its samples
  std::uint32_t first, last;  ///< of the samples that the block wants
  MaskN wanted;
  RayResult missed;  ///< what arrives where nothing was hit
};

/// A block some packets of which have their results.
template <class Block>
struct OpenBlock {
  Block block;
  BlockSums<Block> sums;
  GroupSums<Block> group_sums;                 ///< in place of them where there are groups
  std::optional<PassSums<Block>> pass_sums{};  ///< beside them, if the film has passes
  BlockError<Block> error;
  std::optional<BlockAovs> followed{};  ///< those that follow mirrors, if the film has any
  int packets = 0;

  OpenBlock(const WaitingPacket<Block>& first, const SumScale& scale, std::size_t groups)
      : block(first.block), sums(scale), group_sums(scale, groups), error(first.first, first.last) {}
};

}  // namespace raytrace
