// N: the surface's unit normal in world space, on the side that is seen; the mean over the pixel, as its colour is.
#pragma once

#include <array>
#include <string_view>

#include "raytrace/aovs/aov.h"
#include "raytrace/scene/scene.h"

namespace raytrace {

class Normal {
 public:
  static constexpr std::string_view name = "normal";
  static constexpr AovRule rule = AovRule::mean;
  static constexpr std::array<std::string_view, 3> channels{"N.X", "N.Y", "N.Z"};
  static float largest(const Scene&) { return 1.001F; }  // unit length, and room for its rounding

  template <class Surface>
  static auto values(const Surface& surface) {
    const auto& normal = surface.normal();
    return std::array{normal.x, normal.y, normal.z};
  }
};

}  // namespace raytrace
