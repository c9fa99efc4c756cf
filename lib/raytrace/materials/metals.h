// Colours of metals.
//
// Fresnel's equations of measured refractive indices and extinction coefficients, weighted by the CIE's 1931 observer
// and daylight D65, in linear sRGB, where white has 1; gold's red of 1.036 is cut to 1. The measurements are those of
// Johnson and Christy (1972: gold, silver, copper; 1974: chromium, iron, nickel, titanium), Rakić (1995: aluminium;
// Rakić et al. 1998: platinum) and Querry (1985: brass of 70 % copper and 30 % zinc), as refractiveindex.info has them.
#pragma once

#include <array>
#include <string_view>

#include "raytrace/parameters/fields.h"

namespace raytrace {

enum class Metal { none, aluminium, brass, chromium, copper, gold, iron, nickel, platinum, silver, titanium };
template <>
struct Choices<Metal> {
  static constexpr std::array<std::string_view, 11> words = {
      "none", "aluminium", "brass", "chromium", "copper", "gold", "iron", "nickel", "platinum", "silver", "titanium"};
};

struct MetalColors {
  Rgb<double> normal;  ///< what is reflected straight back
  Rgb<double> edge;    ///< at 82 degrees, over what Schlick's approximation has there; at most 1
};

/// By Metal.
inline constexpr std::array<MetalColors, Choices<Metal>::words.size()> metal_colors{{
    {{0, 0, 0}, {0, 0, 0}},
    {{0.907, 0.916, 0.922}, {0.874, 0.903, 0.933}},
    {{0.908, 0.779, 0.423}, {0.952, 0.979, 1}},
    {{0.550, 0.556, 0.554}, {0.741, 0.749, 0.814}},
    {{0.929, 0.624, 0.522}, {0.982, 0.947, 0.945}},
    {{1, 0.730, 0.364}, {0.990, 1, 0.981}},
    {{0.529, 0.513, 0.494}, {0.765, 0.767, 0.802}},
    {{0.696, 0.641, 0.563}, {0.815, 0.834, 0.871}},
    {{0.677, 0.638, 0.584}, {0.793, 0.818, 0.853}},
    {{0.989, 0.984, 0.978}, {0.993, 0.995, 0.999}},
    {{0.618, 0.580, 0.543}, {0.769, 0.790, 0.821}},
}};

}  // namespace raytrace
