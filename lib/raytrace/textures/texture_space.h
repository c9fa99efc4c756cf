// Where textures in space are fixed.
#pragma once

#include <array>
#include <string_view>

#include "raytrace/parameters/fields.h"

namespace raytrace {

enum class TextureSpace {
  world,
  object,  ///< where the object was before its transform, and that of its instance: it takes the texture along
};
template <>
struct Choices<TextureSpace> {
  static constexpr std::array<std::string_view, 2> words = {"world", "object"};
};

}  // namespace raytrace
