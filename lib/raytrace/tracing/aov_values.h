// How a hit gives the values of AOVs.
#pragma once

#include <array>
#include <string_view>

#include "raytrace/aovs/aov_table.h"
#include "raytrace/scene/aov_inputs.h"

namespace raytrace {

/// Of aov_table[aov]: Aov::values() packets of floats, in which integers are bits; of a coverage, the indices of what
/// was hit, counted from 0, as a packet of integers. Lanes without a hit hold anything.
template <std::size_t aov>
auto aov_values(const AovInputs& inputs) {
  constexpr std::string_view name = aov_table[aov].name;
  if constexpr (name == "depth") {
    return std::array{inputs.depth()};
  } else if constexpr (name == "position") {
    const Vec3<FloatN> position = inputs.position();
    return std::array{position.x, position.y, position.z};
  } else if constexpr (name == "normal" || name == "denoise_normal") {
    return std::array{inputs.normal().x, inputs.normal().y, inputs.normal().z};
  } else if constexpr (name == "albedo" || name == "denoise_albedo") {
    const Rgb<FloatN> albedo = inputs.albedo();
    return std::array{albedo.red, albedo.green, albedo.blue};
  } else if constexpr (name == "object_id") {
    return std::array{AovInputs::id(inputs.object())};
  } else if constexpr (name == "material_id") {
    return std::array{AovInputs::id(inputs.material())};
  } else if constexpr (name == "crypto_object") {
    return inputs.object();
  } else {
    static_assert(name == "crypto_material", "an AOV needs a case here");
    return inputs.material();
  }
}

/// What the ways of camera rays met first, in each lane, that was neither a mirror nor clear. 0 where there is nothing.
struct FollowedSurface {
  Rgb<FloatN> albedo;
  Vec3<FloatN> normal;
};

/// The same of an AOV that follows mirrors.
template <std::size_t aov>
std::array<FloatN, 3> followed_values(const FollowedSurface& surface) {
  if constexpr (aov_table[aov].name == "denoise_normal") {
    return {surface.normal.x, surface.normal.y, surface.normal.z};
  } else {
    static_assert(aov_table[aov].name == "denoise_albedo", "an AOV that follows mirrors needs a case here");
    return {surface.albedo.red, surface.albedo.green, surface.albedo.blue};
  }
}

/// Whether some of these AOVs follow mirrors.
inline bool follow_mirrors(const AovSet& aovs) {
  for (std::size_t i = 0; i < std::size(aov_table); ++i)
    if (aov_table[i].follows_mirrors && aovs.has(i)) return true;
  return false;
}

}  // namespace raytrace
