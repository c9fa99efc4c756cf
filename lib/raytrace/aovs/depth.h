// Z: how far the nearest surface in the pixel is, measured along the camera's viewing direction, not along the ray: a
// wall across the view has one depth. In world units, from the eye. 1e30 where nothing is seen.
#pragma once

#include <array>
#include <string_view>

#include "raytrace/aovs/aov.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

class Depth {
 public:
  static constexpr std::string_view name = "depth";
  static constexpr AovRule rule = AovRule::nearest;
  static constexpr ChannelType type = ChannelType::float32;
  static constexpr std::array<std::string_view, 1> channels{"Z"};
  static constexpr float nothing = 1e30F;

  template <class Surface>
  static auto values(const Surface& surface) {
    return std::array{surface.depth()};
  }
};

}  // namespace raytrace
