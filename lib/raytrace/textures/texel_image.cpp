#include "raytrace/textures/texel_image.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "raytrace/math/srgb.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {
namespace {

using Rgba4 = std::array<float, 4>;

/// How numbers are kept, and what they mean.
struct ByteValues {
  using Stored = std::uint8_t;
  bool srgb;
  std::array<float, 256> decoded{};

  explicit ByteValues(bool is_srgb) : srgb(is_srgb) {
    for (std::size_t code = 0; code < decoded.size(); ++code) {
      const float number = static_cast<float>(code) / 255;
      decoded[code] = srgb ? linear_of_srgb(number) : number;
    }
  }
  float light(Stored code, std::size_t channel) const {
    return channel < 3 ? decoded[code] : static_cast<float>(code) / 255;
  }
  Stored stored(float light, std::size_t channel) const {
    const float code = srgb && channel < 3 ? srgb_of_linear(light) : light;
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
    if (picture.channels == 1 || i % 4 < 3) number = linear_of_srgb(number);
    std::memcpy(result.pixels.data() + i * sizeof number, &number, sizeof number);
  }
  return result;
}

/// From texels of one number to opaque ones of four.
void copy_grey(const std::byte* from, std::size_t count, TexelFormat format, std::byte* to) {
  const std::size_t bytes = bytes_of(format);
  std::array<std::byte, sizeof(float)> one{std::byte{0xff}, std::byte{0xff}};
  const float one_float = 1;
  const Imath::half one_half(1.0F);
  if (format == TexelFormat::floats) std::memcpy(one.data(), &one_float, sizeof one_float);
  if (format == TexelFormat::halves) std::memcpy(one.data(), &one_half, sizeof one_half);
  for (std::size_t i = 0; i < count; ++i, from += bytes) {
    for (int color = 0; color < 3; ++color, to += bytes) std::memcpy(to, from, bytes);
    std::memcpy(to, one.data(), bytes);
    to += bytes;
  }
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
  levels_of_picture_ = static_cast<int>(levels_.size());
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

std::size_t TexelImage::texel_count() const {
  const Level& last = levels_.back();
  return static_cast<std::size_t>(last.first) + block_texels;
}

std::size_t TexelImage::bytes() const {
  return texel_count() * static_cast<std::size_t>(channels_) * bytes_of(format_);
}

void TexelImage::move_to_file(const std::string& folder) {
  in_file_ = FileMapping(texels_.data(), bytes(), folder);
  texels_ = {};
}

TexelImage TexelImage::of_tiles(std::vector<Tile> tiles) {
  TexelImage all;
  std::size_t texels = 0;
  const Tile& first = tiles.front();
  all.format_ = first.image.format_;
  all.srgb_ = first.image.srgb_;
  int rows = 0;
  for (const Tile& tile : tiles) {
    const TexelImage& image = tile.image;
    if (image.format_ != all.format_)
      throw PictureError("the numbers of its tiles " + std::to_string(udim_number(first.column, first.row)) + " and " +
                         std::to_string(udim_number(tile.column, tile.row)) + " have different formats");
    all.channels_ = std::max(all.channels_, image.channels_);
    all.has_alpha_ = all.has_alpha_ || image.has_alpha_;
    all.largest_ = std::max(all.largest_, image.largest_);
    all.levels_of_picture_ = std::max(all.levels_of_picture_, image.levels_of_picture_);
    rows = std::max(rows, tile.row + 1);
    texels += image.texel_count();
  }
  // Look-ups number them by words of 32 bits, with a sign.
  const std::size_t bytes_a_texel = bytes_of(all.format_) * static_cast<std::size_t>(all.channels_);
  if (texels * std::max<std::size_t>(bytes_a_texel / 4, 1) > std::numeric_limits<std::int32_t>::max())
    throw PictureError("its " + std::to_string(tiles.size()) + " tiles are too large together");

  all.tiles_.assign(static_cast<std::size_t>(rows) * tile_columns, -1);
  all.texels_ = LargeArray<std::byte>::zeros(texels * bytes_a_texel);
  std::size_t done = 0;
  for (Tile& tile : tiles) {
    TexelImage image = std::move(tile.image);  // which is freed at the end
    all.tiles_[static_cast<std::size_t>(tile.row * tile_columns + tile.column)] =
        static_cast<std::int32_t>(all.levels_.size());
    for (int i = 0; i < all.levels_of_picture_; ++i) {
      Level level = image.levels_[std::min(static_cast<std::size_t>(i), image.levels_.size() - 1)];
      level.first += static_cast<std::int32_t>(done);
      all.levels_.push_back(level);
    }
    const std::size_t count = image.texel_count();
    std::byte* const to = all.texels_.data() + done * bytes_a_texel;
    if (image.channels_ == all.channels_)
      std::memcpy(to, image.texels_.data(), count * bytes_a_texel);
    else
      copy_grey(image.texels_.data(), count, all.format_, to);
    done += count;
  }
  return all;
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
