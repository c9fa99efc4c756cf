// Which rays those of a packet are, for what is decided by that alone, however the work is cut.
#pragma once

#include <array>
#include <cstdint>

#include "raytrace/math/simd.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/sampler.h"

namespace raytrace {

/// Where several paths go on from a camera ray's first point: the sample whose numbers one of them draws, number
/// `branch` of `branches`, 2 to 16. All branches of a pixel are stratified together. Of samples below
/// 2^24.
inline UintN sample_of_branch(const UintN& sample, std::uint32_t branch, std::uint32_t branches) {
  return ((sample * UintN(branches) + UintN(branch)) & UintN(0x0FFFFFFFU)) | UintN((branches - 1) << 28U);
}
/// The way back; others stay as they are.
[[gnu::noinline]] inline UintN sample_of_pixel(const UintN& sample) {
  if (all(sample < UintN(1U << 28U))) [[likely]]
    return sample;
  alignas(64) std::array<std::uint32_t, packet_lanes> samples;
  sample.store_aligned(samples.data());
  for (std::uint32_t& one : samples) one = (one & 0x0FFFFFFFU) / ((one >> 28U) + 1);
  return UintN::load_aligned(samples.data());
}

/// Which rays they are: of a pixel's sample, and what among those of its path.
struct RayIds {
  const UintN& pixel;   ///< its hash
  const UintN& sample;  ///< perhaps of a branch
  std::uint32_t purpose;

  /// A hash of each, and of what they have in common over the samples of the pixel.
  UintN keys() const { return mix_bits(pixel + sample * UintN(0x9e3779b9u)) + UintN(purpose * 0x9e3779b9u); }
  UintN pixel_keys() const { return mix_bits(pixel + UintN(purpose * 0x9e3779b9u)); }
  /// When they are sent: from 0, when the shutter opens, to 1, the same for all rays of a sample.
  FloatN times() const { return get_2d(pixel, sample_of_pixel(sample), time_dimension).x; }
};

}  // namespace raytrace
