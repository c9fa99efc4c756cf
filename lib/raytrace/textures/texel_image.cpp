#include "raytrace/textures/texel_image.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {
namespace {

using Rgba4 = std::array<float, 4>;

float from_srgb(float code) { return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F); }
float to_srgb(float light) {
  return light <= 0.0031308F ? light * 12.92F : 1.055F * std::pow(light, 1 / 2.4F) - 0.055F;
}

/// How numbers are kept, and what they mean.
struct ByteValues {
  using Stored = std::uint8_t;
  bool srgb;
  std::array<float, 256> decoded{};

  explicit ByteValues(bool is_srgb) : srgb(is_srgb) {
    for (std::size_t code = 0; code < decoded.size(); ++code) {
      const float number = static_cast<float>(code) / 255;
      decoded[code] = srgb ? from_srgb(number) : number;
    }
  }
  float light(Stored code, std::size_t channel) const {
    return channel < 3 ? decoded[code] : static_cast<float>(code) / 255;
  }
  Stored stored(float light, std::size_t channel) const {
    const float code = srgb && channel < 3 ? to_srgb(light) : light;
    return static_cast<Stored>(std::lround(std::clamp(code, 0.0F, 1.0F) * 255));
  }
};
struct Shorts {
  using Stored = std::uint16_t;
  float light(Stored code, std::size_t) const { return static_cast<float>(code) / 65535; }
  Stored stored(float light, std::size_t) const {
    return static_cast<Stored>(std::lround(std::clamp(light, 0.0F, 1.0F) * 65535));
  }
};
template <class Float>
struct Floats {
  using Stored = Float;
  float light(Stored number, std::size_t) const { return number; }
  Stored stored(float light, std::size_t) const { return Float(light); }
};

/// The texels of a line of `from` that one of `to`, evenly spread, covers: the first, and the share of each.
struct Cover {
  std::int32_t first, last;
  float first_share, last_share;  ///< of the others 1

  Cover(std::int32_t i, std::int32_t from, std::int32_t to) {
    const double edge = static_cast<double>(from) / to, begin = i * edge,
                 end = std::min(begin + edge, static_cast<double>(from));
    first = static_cast<std::int32_t>(begin);
    last = std::min(static_cast<std::int32_t>(std::ceil(end)), from) - 1;
    first_share = static_cast<float>(std::min(end, first + 1.0) - begin);
    last_share = static_cast<float>(end - std::max(begin, static_cast<double>(last)));
  }
  float share(std::int32_t texel) const { return texel == first ? first_share : texel == last ? last_share : 1; }
};

/// A copy in floats, in which colours are linear light.
Picture linear_floats(const Picture& picture) {
  Picture result{picture.width, picture.height, picture.channels, TexelFormat::floats, {}, picture.has_alpha};
  const std::size_t numbers = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
                              static_cast<std::size_t>(picture.channels);
  result.pixels = LargeArray<std::byte>::unset(numbers * sizeof(float));
  const std::byte* const from = picture.pixels.data();
  for (std::size_t i = 0; i < numbers; ++i) {
    float number = 0;
    if (picture.format == TexelFormat::shorts) {
      std::uint16_t code = 0;
      std::memcpy(&code, from + i * sizeof code, sizeof code);
      number = static_cast<float>(code) / 65535;
    } else if (picture.format == TexelFormat::halves) {
      Imath::half half;
      std::memcpy(&half, from + i * sizeof half, sizeof half);
      number = half;
    } else {
      std::memcpy(&number, from + i * sizeof number, sizeof number);
    }
    if (picture.channels == 1 || i % 4 < 3) number = from_srgb(number);
    std::memcpy(result.pixels.data() + i * sizeof number, &number, sizeof number);
  }
  return result;
}

}  // namespace

TexelImage::TexelImage(const Picture& picture, bool srgb, int threads)
    : format_(picture.format), channels_(picture.channels), has_alpha_(picture.has_alpha), srgb_(srgb) {
  if (srgb && format_ != TexelFormat::bytes) {
    *this = TexelImage(linear_floats(picture), false, threads);
    return;
  }
  std::int32_t texels = 0;
  for (std::int32_t width = picture.width, height = picture.height;;
       width = std::max(width / 2, 1), height = std::max(height / 2, 1)) {
    const std::int32_t blocks = (width + block_edge - 1) / block_edge, rows = (height + block_edge - 1) / block_edge;
    levels_.push_back({width, height, blocks, texels});
    texels += blocks * rows * block_texels;
    if (width == 1 && height == 1) break;
  }
  texels_ = LargeArray<std::byte>::zeros(static_cast<std::size_t>(texels) * static_cast<std::size_t>(channels_) *
                                         bytes_of(format_));
  switch (format_) {
    case TexelFormat::bytes:
      fill(picture, ByteValues(srgb), threads);
      break;
    case TexelFormat::shorts:
      fill(picture, Shorts{}, threads);
      break;
    case TexelFormat::halves:
      fill(picture, Floats<Imath::half>{}, threads);
      break;
    case TexelFormat::floats:
      fill(picture, Floats<float>{}, threads);
      break;
  }
}

std::shared_ptr<const TexelImage> TexelImage::of_color(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  Picture picture{1, 1, 4, TexelFormat::bytes, LargeArray<std::byte>::zeros(4)};
  for (std::size_t i = 0; i < 4; ++i) picture.pixels[i] = std::byte{std::array{red, green, blue, std::uint8_t{255}}[i]};
  return std::make_shared<const TexelImage>(picture, false, 1);
}

template <class Numbers>
void TexelImage::fill(const Picture& picture, const Numbers& numbers, int threads) {
  using Stored = typename Numbers::Stored;
  const auto channels = static_cast<std::size_t>(channels_);
  auto* const texels = reinterpret_cast<Stored*>(texels_.data());
  std::vector<float> largest(static_cast<std::size_t>(picture.height), 1);
  for_each_index(picture.height, threads, [&](int row) {
    const auto* from = reinterpret_cast<const Stored*>(picture.pixels.data()) +
                       static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) * channels;
    for (int x = 0; x < picture.width; ++x, from += channels) {
      Stored* const to = texels + static_cast<std::size_t>(index(levels_[0], x, picture.height - 1 - row)) * channels;
      for (std::size_t c = 0; c < channels; ++c) {
        to[c] = from[c];
        if constexpr (std::is_same_v<Stored, float> || std::is_same_v<Stored, Imath::half>) {
          const float number = from[c];
          if (!std::isfinite(number)) to[c] = Stored(0.0F);
          float& most = largest[static_cast<std::size_t>(row)];
          if (std::isfinite(number)) most = std::max(most, std::abs(number));
        }
      }
    }
  });
  largest_ = *std::max_element(largest.begin(), largest.end());
  for (std::size_t level = 1; level < levels_.size(); ++level) fill_level(level, numbers, threads);
}

template <class Numbers>
void TexelImage::fill_level(std::size_t level, const Numbers& numbers, int threads) {
  using Stored = typename Numbers::Stored;
  const Level &from = levels_[level - 1], &to = levels_[level];
  const auto channels = static_cast<std::size_t>(channels_);
  auto* const texels = reinterpret_cast<Stored*>(texels_.data());
  for_each_index(to.height, threads, [&](int y) {
    const Cover rows(y, from.height, to.height);
    for (int x = 0; x < to.width; ++x) {
      const Cover columns(x, from.width, to.width);
      Rgba4 sum{};
      float all = 0;
      for (std::int32_t v = rows.first; v <= rows.last; ++v)
        for (std::int32_t u = columns.first; u <= columns.last; ++u) {
          const float share = rows.share(v) * columns.share(u);
          const Stored* const texel = texels + static_cast<std::size_t>(index(from, u, v)) * channels;
          all += share;
          for (std::size_t c = 0; c < channels; ++c) sum[c] += share * numbers.light(texel[c], c);
        }
      Stored* const texel = texels + static_cast<std::size_t>(index(to, x, y)) * channels;
      for (std::size_t c = 0; c < channels; ++c) texel[c] = numbers.stored(sum[c] / all, c);
    }
  });
}

}  // namespace raytrace
