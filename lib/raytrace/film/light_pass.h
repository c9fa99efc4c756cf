// The parts of a picture's light by what the camera's way met first: passes, as compositing programs call them.
#pragma once

#include <cstddef>
#include <iterator>
#include <string_view>

namespace raytrace {

/// What a sample's light was scattered by, the first time on the way from the camera; direct: the last time, too. They
/// add up to the picture. The order is that of their AOVs in aov_table (aovs/aov_table.h).
enum class LightPass {
  diffuse_direct,
  diffuse_indirect,
  specular_direct,
  specular_indirect,
  transmission_direct,
  transmission_indirect,
  volume_direct,
  volume_indirect,
  emission,    ///< none: of surfaces that shine
  background,  ///< none: of what is infinitely far
};
inline constexpr std::string_view light_pass_names[] = {
    "diffuse_direct",        "diffuse_indirect", "specular_direct", "specular_indirect", "transmission_direct",
    "transmission_indirect", "volume_direct",    "volume_indirect", "emission",          "background"};
inline constexpr std::size_t light_pass_count = std::size(light_pass_names);

}  // namespace raytrace
