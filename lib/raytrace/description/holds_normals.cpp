#include "raytrace/description/holds_normals.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "raytrace/output/picture.h"

namespace raytrace {
namespace {

/// Whether the mean blue is far more than the mean red and green. Channel: of so many that a pixel has.
template <class Channel>
bool is_blue(const Picture& picture, double most) {
  const std::size_t pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  const auto channels = static_cast<std::size_t>(picture.channels);
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      Channel value{};
      std::memcpy(&value, picture.pixels.data() + (i * channels + k) * sizeof value, sizeof value);
      sums[k] += static_cast<double>(value);
    }
  // Flat ground is (0.5, 0.5, 1); heights are grey.
  constexpr double difference = 0.15;
  return sums[2] - std::max(sums[0], sums[1]) > difference * most * static_cast<double>(pixels);
}

/// Whether red, green and blue have the same bits, 16 of each.
bool is_grey(const Picture& picture) {
  const std::size_t pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::array<std::uint16_t, 3> colors{};
    std::memcpy(colors.data(), picture.pixels.data() + i * channels * sizeof colors[0], sizeof colors);
    if (colors[0] != colors[1] || colors[1] != colors[2]) return false;
  }
  return true;
}

}  // namespace

bool is_grey(const TexelImage& image) {
  if (image.channels() < 3) return true;
  const std::size_t bytes = bytes_of(image.format());
  const TexelImage::Level& level = image.levels().front();
  constexpr std::int32_t most = 64;  // along an edge
  const std::int32_t columns = std::min(level.width, most), rows = std::min(level.height, most);
  for (std::int32_t row = 0; row < rows; ++row)
    for (std::int32_t column = 0; column < columns; ++column) {
      const auto along = [](std::int32_t i, std::int32_t count, std::int32_t size) {
        return static_cast<std::int32_t>(std::int64_t{i} * size / count);
      };
      const auto number = static_cast<std::size_t>(
          TexelImage::index(level, along(column, columns, level.width), along(row, rows, level.height)));
      const std::byte* const texel = image.texels() + number * static_cast<std::size_t>(image.channels()) * bytes;
      if (std::memcmp(texel, texel + bytes, bytes) != 0 || std::memcmp(texel, texel + 2 * bytes, bytes) != 0)
        return false;
    }
  return true;
}

bool holds_normals(const std::string& file) {
  try {
    const auto reader = open_picture(file);
    if (reader->layout().channels < 3) return false;
    const Picture picture = reader->read();
    switch (picture.format) {
      case TexelFormat::bytes:
        return is_blue<std::uint8_t>(picture, 255);
      case TexelFormat::shorts:
        return is_blue<std::uint16_t>(picture, 65535);
      case TexelFormat::floats:
        return is_blue<float>(picture, 1);
      default:
        return !is_grey(picture);
    }
  } catch (const std::runtime_error&) {
    return true;
  }
}

}  // namespace raytrace
