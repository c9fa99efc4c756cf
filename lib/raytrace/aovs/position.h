// P: where the nearest surface in the pixel is, in world space. (0, 0, 0) where nothing is seen.
#pragma once

#include <array>
#include <string_view>

#include "raytrace/aovs/aov.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

class Position {
 public:
  static constexpr std::string_view name = "position";
  static constexpr AovRule rule = AovRule::nearest;
  static constexpr ChannelType type = ChannelType::float32;
  static constexpr std::array<std::string_view, 3> channels{"P.X", "P.Y", "P.Z"};
  static constexpr float nothing = 0;

  template <class Surface>
  static auto values(const Surface& surface) {
    const auto& position = surface.position();
    return std::array{position.x, position.y, position.z};
  }
};

}  // namespace raytrace
