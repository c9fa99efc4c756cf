// Look-ups in the texels of images: between four texels, and between two of the ever smaller pictures.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "raytrace/math/gather.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/rgba.h"
#include "raytrace/math/simd.h"
#include "raytrace/textures/image.h"
#include "raytrace/textures/texel_image.h"
#include "raytrace/textures/texture_point.h"

namespace raytrace {

template <>
class Kernel<Image> {
 public:
  /// texels: null of an image that has not been loaded, which is magenta.
  Kernel(const Image::Parameters& image, std::shared_ptr<const TexelImage> texels)
      : texels_(texels ? std::move(texels) : TexelImage::of_color(255, 0, 255)),
        wrap_u_(image.wrap),
        wrap_v_(Image::wrap_v(image)),
        filter_(image.filter),
        uvset_(image.uvset),
        offset_{static_cast<float>(image.uvoffset.x), static_cast<float>(image.uvoffset.y)},
        value_scale_(static_cast<float>(image.valuescale)),
        value_offset_(static_cast<float>(image.valueoffset)),
        is_by_vertices_(image.vertexalpha) {
    const double angle = image.uvrotation * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    across_ = {static_cast<float>(c * image.uvscale.x), static_cast<float>(-s * image.uvscale.y)};
    up_ = {static_cast<float>(s * image.uvscale.x), static_cast<float>(c * image.uvscale.y)};
    if (!texels_->tiles().empty()) wrap_u_ = wrap_v_ = Wrap::clamp;
  }

  UvSet uvset() const { return uvset_; }
  float largest() const { return std::abs(value_scale_) * texels_->largest() + std::abs(value_offset_); }
  bool has_alpha() const { return texels_->has_alpha(); }
  std::int32_t width() const { return texels_->levels()[0].width; }
  std::int32_t height() const { return texels_->levels()[0].height; }

  /// A texel of the picture, whose rows count from the bottom, in linear light.
  Rgb<FloatN> texel(const IntN& column, const IntN& row) const {
    return texels(index(levels_of(LaneIndices(0)), column, row)).color;
  }

  Rgba<FloatN> at(const TexturePoint<FloatN>& point) const {
    Rgba<FloatN> value = in_file(point.by(uvset_));
    if (is_by_vertices_) value = {value.color * point.vertex_alpha, value.alpha * point.vertex_alpha};
    return value_scale_ == 1 && value_offset_ == 0 ? value : scaled(value, value_scale_, value_offset_);
  }

 private:
  Rgba<FloatN> in_file(const UvPoint<FloatN>& point) const {
    const Vec2<FloatN> turned = in_picture(point.uv);
    const Vec2<FloatN> uv{turned.x + FloatN(offset_.x), turned.y + FloatN(offset_.y)};
    return texels_->tiles().empty() ? in_picture_at(point, uv, LaneIndices(0)) : in_tiles(point, uv);
  }

  /// Each lane in the tile that its place is in. Where there is no tile, all is 0, alpha too.
  Rgba<FloatN> in_tiles(const UvPoint<FloatN>& point, const Vec2<FloatN>& uv) const {
    const Vec2<FloatN> corner{floor(uv.x), floor(uv.y)};
    const std::vector<std::int32_t>& tiles = texels_->tiles();
    const auto columns = static_cast<float>(TexelImage::tile_columns);
    const float rows = static_cast<float>(tiles.size()) / columns;
    const MaskN in_grid =
        (corner.x >= FloatN(0)) & (corner.x < FloatN(columns)) & (corner.y >= FloatN(0)) & (corner.y < FloatN(rows));
    const FloatN place = select(in_grid, multiply_add(corner.y, FloatN(columns), corner.x), FloatN(0));
    const IntN first = gather(tiles.data(), to_int(place));
    const MaskN is_there = in_grid & float_mask<FloatN>(first >= IntN(0));
    const Rgba<FloatN> found =
        in_picture_at(point, {uv.x - corner.x, uv.y - corner.y}, LaneIndices(max(first, IntN(0))));
    const FloatN zero(0);
    return select(is_there, found, Rgba<FloatN>{{zero, zero, zero}, zero});
  }

  /// first: the picture's first level.
  Rgba<FloatN> in_picture_at(const UvPoint<FloatN>& point, const Vec2<FloatN>& uv, const LaneIndices& first) const {
    if (filter_ == TextureFilter::nearest) return nearest(uv, first);
    const std::int32_t last = texels_->levels_of_picture() - 1;
    // What the view stretches most is left to the samples of the pixel, up to a factor of two.
    const Levels sharpest = levels_of(first);
    const Vec2<FloatN> size{to_float(sharpest.width), to_float(sharpest.height)};
    const FloatN a = texels_covered(point.uv_across, size), b = texels_covered(point.uv_along, size);
    const FloatN wide = max(min(a, b), max(a, b) * FloatN(0.5F));
    const FloatN level = min(max(log(max(wide, FloatN(1))) * FloatN(std::numbers::log2e_v<float>), FloatN(0)),
                             FloatN(static_cast<float>(last)));
    const IntN lower = clamped(to_int(level), IntN(last));
    const FloatN part = level - to_float(lower);
    // Most images by code of their own, without a choice of the format for each texel.
    const auto level_at = [&](const IntN& number) {
      const IntN of_all = first.lanes() + number;
      return is_usual() ? between_texels<true>(of_all, uv) : between_texels<false>(of_all, uv);
    };
    const Rgba<FloatN> sharper = level_at(lower);
    if (none(part > FloatN(0))) return sharper;
    return mix(sharper, level_at(min(lower + IntN(1), IntN(last))), part);
  }

  /// The texels of a row or column that a look-up is between, those left out being black.
  struct Neighbours {
    IntN low, high;
    FloatN part;  ///< of the higher one
    MaskN has_low, has_high;
  };

  static IntN clamped(const IntN& number, const IntN& largest) { return min(max(number, IntN(0)), largest); }

  Vec2<FloatN> in_picture(const Vec2<FloatN>& uv) const {
    return {multiply_add(FloatN(across_.x), uv.x, FloatN(across_.y) * uv.y),
            multiply_add(FloatN(up_.x), uv.x, FloatN(up_.y) * uv.y)};
  }

  /// size: of the picture.
  FloatN texels_covered(const Vec2<FloatN>& axis, const Vec2<FloatN>& size) const {
    const Vec2<FloatN> turned = in_picture(axis);
    return covered(turned.x * size.x, turned.y * size.y);
  }

  /// The coordinate in [0, 1], or near it where what lies beyond has its own rule.
  static RAYTRACE_INLINE FloatN wrapped(const FloatN& u, Wrap wrap) {
    if (wrap == Wrap::repeat) return u - floor(u);
    if (wrap == Wrap::mirror) return FloatN(1) - abs(u - FloatN(2) * floor(u * FloatN(0.5F)) - FloatN(1));
    return min(max(u, FloatN(-1)), FloatN(2));
  }

  /// u: wrapped. Whatever it is, even not a number, the texels are there.
  static RAYTRACE_INLINE Neighbours neighbours(const FloatN& u, const IntN& size, Wrap wrap) {
    const FloatN x = u * to_float(size) - FloatN(0.5F), left = floor(x);
    IntN low = to_int(left), high = low + IntN(1);
    const IntN last = size - IntN(1);
    const auto is_there = [&](const IntN& i) { return float_mask<FloatN>(clamped(i, last) == i); };
    Neighbours result{low, high, x - left, MaskN(true), MaskN(true)};
    if (wrap == Wrap::black) {
      result.has_low = is_there(low);
      result.has_high = is_there(high);
    } else if (wrap == Wrap::repeat) {
      low = select_lanes(is_there(low), low, last);
      high = select_lanes(is_there(high), high, IntN(0));
    }
    result.low = clamped(low, last);
    result.high = clamped(high, last);
    return result;
  }

  /// A level's numbers for each lane.
  struct Levels {
    IntN width, height, blocks, first;
  };
  Levels levels_of(const LaneIndices& level) const {
    static_assert(sizeof(TexelImage::Level) == 4 * sizeof(std::int32_t));
    const TexelImage::Level* const all = texels_->levels().data();
    if (level.all_same()) {
      const TexelImage::Level& one = all[level.first()];
      return {IntN(one.width), IntN(one.height), IntN(one.blocks), IntN(one.first)};
    }
    const IntN at = level.lanes() * IntN(4);
    const auto number = [&](const std::int32_t TexelImage::Level::* member) { return gather(&(all->*member), at); };
    return {number(&TexelImage::Level::width), number(&TexelImage::Level::height), number(&TexelImage::Level::blocks),
            number(&TexelImage::Level::first)};
  }

  static RAYTRACE_INLINE IntN index(const Levels& level, const IntN& x, const IntN& y) {
    static_assert(TexelImage::block_edge == 4);
    const IntN block = (y >> 2) * level.blocks + (x >> 2);
    return level.first + block * IntN(TexelImage::block_texels) + (y & IntN(3)) * IntN(TexelImage::block_edge) +
           (x & IntN(3));
  }

  bool is_usual() const { return texels_->format() == TexelFormat::bytes && texels_->channels() == 4 && !has_black(); }
  bool has_black() const { return wrap_u_ == Wrap::black || wrap_v_ == Wrap::black; }

  template <bool usual>
  Rgba<FloatN> between_texels(const IntN& number, const Vec2<FloatN>& uv) const {
    const Levels level = levels_of(number);
    const Neighbours x = neighbours(wrapped(uv.x, wrap_u_), level.width, wrap_u_),
                     y = neighbours(wrapped(uv.y, wrap_v_), level.height, wrap_v_);
    const auto texel = [&](const IntN& column, const IntN& row, const MaskN& is_there) RAYTRACE_INLINE_LAMBDA {
      if constexpr (usual) return byte_texels(index(level, column, row));
      const Rgba<FloatN> found = texels(index(level, column, row));
      if (!has_black()) return found;
      const FloatN zero(0);
      return select(is_there, found, Rgba<FloatN>{{zero, zero, zero}, zero});
    };
    const auto row = [&](const IntN& at, const MaskN& is_there) RAYTRACE_INLINE_LAMBDA {
      return mix(texel(x.low, at, is_there & x.has_low), texel(x.high, at, is_there & x.has_high), x.part);
    };
    return mix(row(y.low, y.has_low), row(y.high, y.has_high), y.part);
  }

  Rgba<FloatN> nearest(const Vec2<FloatN>& uv, const LaneIndices& first) const {
    const Levels level = levels_of(first);
    const auto column = [&](const FloatN& u, const IntN& size, Wrap wrap, MaskN& is_there) {
      const IntN i = to_int(floor(wrapped(u, wrap) * to_float(size))), inside = clamped(i, size - IntN(1));
      if (wrap == Wrap::black) is_there = is_there & float_mask<FloatN>(i == inside);
      return inside;
    };
    MaskN is_there(true);
    const IntN x = column(uv.x, level.width, wrap_u_, is_there), y = column(uv.y, level.height, wrap_v_, is_there);
    const Rgba<FloatN> found = texels(index(level, x, y));
    if (!has_black()) return found;
    const FloatN zero(0);
    return select(is_there, found, Rgba<FloatN>{{zero, zero, zero}, zero});
  }

  /// In linear light.
  Rgba<FloatN> texels(const IntN& index) const {
    const std::byte* const all = texels_->texels();
    switch (texels_->format()) {
      case TexelFormat::bytes:
        return texels_->channels() == 4 ? byte_texels(index) : each_texel<std::uint8_t>(index);
      case TexelFormat::shorts:
        return each_texel<std::uint16_t>(index);
      case TexelFormat::halves:
        return texels_->channels() == 4 ? half_texels(index) : each_texel<Half>(index);
      default:
        break;
    }
    if (texels_->channels() == 4) {
      const IntN first = index * IntN(4);
      const auto* const floats = reinterpret_cast<const float*>(all);
      return {{gather(floats, first), gather(floats + 1, first), gather(floats + 2, first)}, gather(floats + 3, first)};
    }
    const FloatN grey = gather(reinterpret_cast<const float*>(all), index);
    return {{grey, grey, grey}, FloatN(1)};
  }

  RAYTRACE_INLINE Rgba<FloatN> byte_texels(const IntN& index) const {
    const UintN word = same_bits<UintN>(gather(reinterpret_cast<const std::int32_t*>(texels_->texels()), index));
    const auto number = [&](const UintN& code) { return to_float(same_bits<IntN>(code)) * FloatN(1.0F / 255); };
    const UintN byte(255U);
    return {{light(number(word & byte)), light(number((word >> 8) & byte)), light(number((word >> 16) & byte))},
            number(word >> 24)};
  }

  RAYTRACE_INLINE Rgba<FloatN> half_texels(const IntN& index) const {
    const auto* const words = reinterpret_cast<const std::int32_t*>(texels_->texels());
    const UintN first = same_bits<UintN>(gather(words, index * IntN(2)));
    const UintN second = same_bits<UintN>(gather(words + 1, index * IntN(2)));
    // As number() does it.
    const auto low = [](const UintN& halves) {
      const FloatN magnitude = same_bits<FloatN>((halves & UintN(0x7fffU)) << 13) * FloatN(0x1p112F);
      return same_bits<FloatN>(same_bits<UintN>(magnitude) | ((halves & UintN(0x8000U)) << 16));
    };
    return {{low(first), low(first >> 16), low(second)}, low(second >> 16)};
  }

  /// That a colour's number in [0, 1] stands for. Of sRGB within 0.0002, and a thousandth of it.
  RAYTRACE_INLINE FloatN light(const FloatN& x) const {
    if (!texels_->srgb()) return x;
    constexpr std::array powers{0.0898338859F, -0.313210738F, 0.671128477F,
                                0.518562483F,  0.0327671605F, 0.000918731261F};
    FloatN sum(powers[0]);
    for (std::size_t i = 1; i < powers.size(); ++i) sum = multiply_add(sum, x, FloatN(powers[i]));
    return select(x < FloatN(0.04045F), x * FloatN(1 / 12.92F), sum);
  }

  struct Half {
    std::uint16_t bits;
  };
  static float number(std::uint8_t code) { return static_cast<float>(code) * (1.0F / 255); }
  static float number(std::uint16_t code) { return static_cast<float>(code) * (1.0F / 65535); }
  /// Finite.
  static float number(Half half) {
    const auto magnitude = std::bit_cast<float>(static_cast<std::uint32_t>(half.bits & 0x7fffU) << 13U) * 0x1p112F;
    return half.bits >> 15U ? -magnitude : magnitude;
  }

  template <class Stored>
  Rgba<FloatN> each_texel(const IntN& index) const {
    alignas(64) std::array<std::int32_t, packet_lanes> indices;
    index.store_aligned(indices.data());
    alignas(64) std::array<std::array<float, packet_lanes>, 4> numbers{};
    const auto channels = static_cast<std::size_t>(texels_->channels());
    const std::byte* const all = texels_->texels();
    for (std::size_t lane = 0; lane < packet_lanes; ++lane)
      for (std::size_t channel = 0; channel < channels; ++channel) {
        Stored stored;
        std::memcpy(&stored, all + (static_cast<std::size_t>(indices[lane]) * channels + channel) * sizeof stored,
                    sizeof stored);
        numbers[channel][lane] = number(stored);
      }
    const auto loaded = [&](std::size_t channel) { return FloatN::load_aligned(numbers[channel].data()); };
    if (channels == 4) return {{light(loaded(0)), light(loaded(1)), light(loaded(2))}, loaded(3)};
    const FloatN grey = light(loaded(0));
    return {{grey, grey, grey}, FloatN(1)};
  }

  std::shared_ptr<const TexelImage> texels_;
  Wrap wrap_u_, wrap_v_;
  TextureFilter filter_;
  UvSet uvset_;
  Vec2<float> across_{}, up_{};  ///< of the place in the picture: what u and v give to its coordinates
  Vec2<float> offset_;
  float value_scale_, value_offset_;
  bool is_by_vertices_;
};

}  // namespace raytrace
