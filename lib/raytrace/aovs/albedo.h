// albedo: the share of light that the material scatters diffusely (kd * cd); the mean over the pixel, as its colour is.
#pragma once

#include <array>
#include <string_view>

#include "raytrace/aovs/aov.h"
#include "raytrace/scene/scene.h"

namespace raytrace {

class Albedo {
 public:
  static constexpr std::string_view name = "albedo";
  static constexpr AovRule rule = AovRule::mean;
  static constexpr std::array<std::string_view, 3> channels{"albedo.R", "albedo.G", "albedo.B"};
  static float largest(const Scene& scene) { return scene.largest_albedo(); }

  template <class Surface>
  static auto values(const Surface& surface) {
    const auto albedo = surface.albedo();
    return std::array{albedo.red, albedo.green, albedo.blue};
  }
};

}  // namespace raytrace
