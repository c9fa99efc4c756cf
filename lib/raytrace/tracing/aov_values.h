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
  } else if constexpr (name == "normal") {
    return std::array{inputs.normal().x, inputs.normal().y, inputs.normal().z};
  } else if constexpr (name == "albedo") {
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

}  // namespace raytrace
