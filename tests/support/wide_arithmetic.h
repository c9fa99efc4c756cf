// Arithmetic of the wide code as it is compiled for each instruction set: their registers and instructions differ.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace raytrace::test {

using WideLanes = std::array<float, 16>;
using WideDoubles = std::array<double, 16>;
using WideSums = std::array<std::int64_t, 16>;

struct PacketSums {
  std::vector<std::int64_t> exact;
  std::vector<double> rounded;
};

/// What one instruction set makes of 16 lanes in registers of 4, 8 or 16 floats (`lanes`; where it has none such, in
/// its native ones).
struct WideArithmetic {
  using Operation = WideLanes (*)(int lanes, const WideLanes& a, const WideLanes& b, const WideLanes& c);
  Operation exact_fma;
  Operation double_sum;  ///< a * b + c in Doubles, rounded
  Operation below;       ///< 1 where a * b < c in Doubles, else 0
  /// FixedPointSums of the terms, which are added in their order. units: one over the unit.
  WideSums (*fixed_point_sums)(int lanes, std::span<const WideLanes> terms, double units);
  WideDoubles (*rounded_sums)(int lanes, std::span<const WideLanes> terms, double units);
  /// `count` such sums (1, 2, 4 or 8) of packets: term i, of a multiple of 32, belongs to sum i % count.
  PacketSums (*packet_sums)(int count, std::span<const float> terms, double units);
};

/// isa: one of isa_names() that isa_supported().
const WideArithmetic& wide_arithmetic(const std::string& isa);

}  // namespace raytrace::test
