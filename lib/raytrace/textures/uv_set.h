// The sets of texture coordinates that a mesh may have.
#pragma once

#include <array>
#include <string_view>

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// A mesh without a second set, and every other shape, has its first one in both places.
enum class UvSet { first, second };
template <>
struct Choices<UvSet> {
  static constexpr std::array<std::string_view, 2> words = {"1", "2"};
};

}  // namespace raytrace
