// samples: how many samples the pixel has.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "raytrace/aovs/aov.h"
#include "raytrace/film/film.h"

namespace raytrace {

class SampleCount {
 public:
  static constexpr std::string_view name = "samples";
  static constexpr AovRule rule = AovRule::film;
  static constexpr std::array<std::string_view, 1> channels{"samples"};
  static std::uint32_t value(const PixelSum& pixel) { return pixel.samples; }
};

}  // namespace raytrace
