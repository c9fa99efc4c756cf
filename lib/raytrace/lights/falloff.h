// How the light of a point grows weaker with distance.
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

enum class Falloff {
  none,            ///< the same radiance at every distance, as in the seed
  inverse_square,  ///< divided by the square of the distance, as light does
};

template <>
struct Choices<Falloff> {
  static constexpr std::array<std::string_view, 2> words = {"none", "inversesquare"};
};

}  // namespace raytrace
