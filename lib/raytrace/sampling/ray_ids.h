// Which rays those of a packet are, for what is decided by that alone, however the work is cut.
#pragma once

#include <cstdint>

#include "raytrace/math/simd.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/sampler.h"

namespace raytrace {

/// Which rays they are: of a pixel's sample, and what among those of its path.
struct RayIds {
  const UintN& pixel;  ///< its hash
  const UintN& sample;
  std::uint32_t purpose;

  /// A hash of each.
  UintN keys() const { return mix_bits(pixel + sample * UintN(0x9e3779b9u)) + UintN(purpose * 0x9e3779b9u); }
  /// When they are sent: from 0, when the shutter opens, to 1, the same for all rays of a sample.
  FloatN times() const { return get_2d(pixel, sample, time_dimension).x; }
};

}  // namespace raytrace
