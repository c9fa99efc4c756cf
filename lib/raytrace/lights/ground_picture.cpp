#include "raytrace/lights/ground_picture.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>

namespace raytrace {

Picture picture_of_ground(double ground) {
  constexpr int width = 4, height = 256;
  Picture result{{width, height, 4, TexelFormat::floats},
                 LargeArray<std::byte>::unset(std::size_t{width} * height * 4 * sizeof(float))};
  std::byte* out = result.pixels.data();
  for (int row = 0; row < height; ++row) {
    const double up = (1 + std::cos(std::numbers::pi * (row + 0.5) / height)) / 2;
    const auto value = static_cast<float>(ground + (1 - ground) * up);
    const std::array<float, 4> texel{value, value, value, 1};
    for (int column = 0; column < width; ++column, out += sizeof texel) std::memcpy(out, texel.data(), sizeof texel);
  }
  return result;
}

}  // namespace raytrace
