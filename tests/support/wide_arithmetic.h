// Arithmetic of the wide code as it is compiled for each instruction set: their registers and instructions differ.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace raytrace::test {

using WideLanes = std::array<float, 16>;

/// What one instruction set makes of 16 lanes in registers of 4, 8 or 16 floats (`lanes`; where it has none such, in
/// its native ones).
struct WideArithmetic {
  using Operation = WideLanes (*)(int lanes, const WideLanes& a, const WideLanes& b, const WideLanes& c);
  Operation exact_fma;
  Operation double_sum;  ///< a * b + c in Doubles, rounded
  Operation below;       ///< 1 where a * b < c in Doubles, else 0
};

/// isa: one of isa_names() that isa_supported().
const WideArithmetic& wide_arithmetic(const std::string& isa);

}  // namespace raytrace::test
