// Pictures of random numbers, and what they mean, in double precision.
#pragma once

#include <half.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

#include "raytrace/textures/texel_image.h"

namespace raytrace::test {

inline Picture random_picture(std::mt19937& random, int width, int height, int channels, TexelFormat format) {
  Picture picture{width, height, channels, format, {}};
  const std::size_t numbers =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
  picture.pixels = LargeArray<std::byte>::zeros(numbers * bytes_of(format));
  for (std::size_t i = 0; i < numbers; ++i) {
    const float unit = static_cast<float>(random() >> 8U) * 0x1p-24F;
    const auto code = static_cast<std::uint32_t>(random());
    std::byte* const at = picture.pixels.data() + i * bytes_of(format);
    const Imath::half half(unit * 3 - 1);
    const float number = unit * 5 - 2;
    if (format == TexelFormat::halves)
      std::memcpy(at, &half, sizeof half);
    else if (format == TexelFormat::floats)
      std::memcpy(at, &number, sizeof number);
    else
      std::memcpy(at, &code, bytes_of(format));
  }
  return picture;
}

using Color4 = std::array<double, 4>;

inline double decoded_srgb(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

/// What a texel of a level means, read by the documented layout.
inline Color4 texel_of(const TexelImage& image, std::size_t level, int x, int y, bool srgb) {
  const auto channels = static_cast<std::size_t>(image.channels());
  const auto first = static_cast<std::size_t>(TexelImage::index(image.levels()[level], x, y)) * channels;
  Color4 color{0, 0, 0, 1};
  for (std::size_t c = 0; c < channels; ++c) {
    const std::byte* const at = image.texels() + (first + c) * bytes_of(image.format());
    std::uint16_t code = 0;
    float number = 0;
    Imath::half half;
    switch (image.format()) {
      case TexelFormat::bytes:
        color[c] = std::to_integer<int>(*at) / 255.0;
        if (srgb && c < 3) color[c] = decoded_srgb(color[c]);
        break;
      case TexelFormat::shorts:
        std::memcpy(&code, at, sizeof code);
        color[c] = code / 65535.0;
        break;
      case TexelFormat::halves:
        std::memcpy(&half, at, sizeof half);
        color[c] = static_cast<double>(static_cast<float>(half));
        break;
      case TexelFormat::floats:
        std::memcpy(&number, at, sizeof number);
        color[c] = static_cast<double>(number);
        break;
    }
  }
  if (channels == 1) color[1] = color[2] = color[0];
  return color;
}

}  // namespace raytrace::test
