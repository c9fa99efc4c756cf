#include "raytrace/textures/texture_value.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "raytrace/math/srgb.h"

namespace raytrace {

namespace {

TextureValue between(const TextureValue& a, const TextureValue& b, double part) {
  TextureValue value;
  for (std::size_t i = 0; i < 4; ++i) value[i] = a[i] + (b[i] - a[i]) * part;
  return value;
}

TextureValue scaled_value(TextureValue value, double scale, double offset) {
  for (double& number : value) number = number * scale + offset;
  return value;
}

class TexelReader {
 public:
  TexelReader(const Image::Parameters& image, const TexelImage& texels)
      : texels_(texels),
        wrap_u_(image.wrap),
        wrap_v_(Image::wrap_v(image)),
        nearest_(image.filter == TextureFilter::nearest) {
    if (!texels.tiles().empty()) wrap_u_ = wrap_v_ = Wrap::clamp;
  }

  /// first: the picture's first level. wide: how much of u and of v counts.
  TextureValue at(const Vec2d& uv, const Vec2d& across, const Vec2d& along, std::int32_t first) const {
    const TexelImage::Level& sharpest = level(first);
    if (nearest_) return nearest(sharpest, uv);
    const auto covered = [&](const Vec2d& axis) {
      return std::hypot(axis.x * sharpest.width, axis.y * sharpest.height);
    };
    const double a = covered(across), b = covered(along);
    const double wide = std::max(std::min(a, b), std::max(a, b) / 2);
    const double last = texels_.levels_of_picture() - 1;
    const double number = std::clamp(std::log2(std::max(wide, 1.0)), 0.0, last);
    const auto lower = static_cast<std::int32_t>(number);
    const TextureValue sharper = between_texels(level(first + lower), uv);
    if (number == lower) return sharper;
    return between(sharper, between_texels(level(first + lower + 1), uv), number - lower);
  }

 private:
  const TexelImage::Level& level(std::int32_t number) const {
    return texels_.levels()[static_cast<std::size_t>(number)];
  }

  static double wrapped(double u, Wrap wrap) {
    if (!std::isfinite(u)) return 0;
    if (wrap == Wrap::repeat) return u - std::floor(u);
    if (wrap == Wrap::mirror) return 1 - std::abs(u - 2 * std::floor(u / 2) - 1);
    return std::clamp(u, -1.0, 2.0);
  }

  /// Black where that is beyond.
  TextureValue texel(const TexelImage::Level& level, std::int32_t x, std::int32_t y) const {
    if (!place(x, level.width, wrap_u_) || !place(y, level.height, wrap_v_)) return {0, 0, 0, 0};
    const auto index = static_cast<std::size_t>(TexelImage::index(level, x, y));
    const auto channels = static_cast<std::size_t>(texels_.channels());
    TextureValue value{0, 0, 0, 1};
    for (std::size_t i = 0; i < channels; ++i) value[i] = number(index * channels + i);
    for (std::size_t i = 0; i < std::min<std::size_t>(channels, 3) && texels_.srgb(); ++i)
      value[i] = linear_of_srgb(value[i]);
    if (channels == 1) value[1] = value[2] = value[0];
    return value;
  }

  /// Puts it into the picture; false where there is none.
  static bool place(std::int32_t& x, std::int32_t size, Wrap wrap) {
    if (x >= 0 && x < size) return true;
    if (wrap == Wrap::black) return false;
    x = wrap == Wrap::repeat ? (x < 0 ? size - 1 : 0) : std::clamp(x, 0, size - 1);
    return true;
  }

  double number(std::size_t i) const {
    const auto load = [&]<class T>(T value) {
      std::memcpy(&value, texels_.texels() + i * sizeof value, sizeof value);
      return value;
    };
    switch (texels_.format()) {
      case TexelFormat::bytes:
        return load(std::uint8_t{}) / 255.0;
      case TexelFormat::shorts:
        return load(std::uint16_t{}) / 65535.0;
      case TexelFormat::halves: {
        const std::uint16_t bits = load(std::uint16_t{});
        const double magnitude =
            double{std::bit_cast<float>(static_cast<std::uint32_t>(bits & 0x7fffU) << 13U)} * 0x1p112;
        return (bits & 0x8000U) != 0 ? -magnitude : magnitude;
      }
      default:
        return double{load(float{})};
    }
  }

  TextureValue between_texels(const TexelImage::Level& level, const Vec2d& uv) const {
    const double x = wrapped(uv.x, wrap_u_) * level.width - 0.5, y = wrapped(uv.y, wrap_v_) * level.height - 0.5;
    const double left = std::floor(x), low = std::floor(y);
    const auto column = static_cast<std::int32_t>(left), row = static_cast<std::int32_t>(low);
    const auto in_row = [&](std::int32_t at) {
      return between(texel(level, column, at), texel(level, column + 1, at), x - left);
    };
    return between(in_row(row), in_row(row + 1), y - low);
  }

  TextureValue nearest(const TexelImage::Level& level, const Vec2d& uv) const {
    // A coordinate of 1 is the last texel's edge, whatever is beyond.
    const auto at = [](double u, std::int32_t size, Wrap wrap) {
      const auto i = static_cast<std::int32_t>(std::floor(wrapped(u, wrap) * size));
      return wrap == Wrap::black ? i : std::clamp(i, 0, size - 1);
    };
    return texel(level, at(uv.x, level.width, wrap_u_), at(uv.y, level.height, wrap_v_));
  }

  const TexelImage& texels_;
  Wrap wrap_u_, wrap_v_;
  bool nearest_;
};

/// Between -1 and 1, as the kernel of Noise has it.
float gradient_noise_at(const Vec3f& p) {
  const Vec3f corner{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3f in_cell = p - corner;
  const auto whole = [](float x) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::clamp(x, -2147483648.0F, 2147483520.0F)));
  };
  const std::uint32_t x = whole(corner.x), y = whole(corner.y), z = whole(corner.z);
  const auto slope = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    std::uint32_t bits = (x + i) * 0x9e3779b1U ^ (y + j) * 0x85ebca77U ^ (z + k) * 0xc2b2ae3dU;
    bits = (bits ^ bits >> 15U) * 0x7feb352dU;
    bits = (bits ^ bits >> 13U) * 0x846ca68bU;
    bits = bits ^ bits >> 16U;
    const float a = in_cell.x - static_cast<float>(i), b = in_cell.y - static_cast<float>(j),
                c = in_cell.z - static_cast<float>(k);
    const float first = (bits & 1U) != 0 ? a : b;
    const float second = (bits & 2U) != 0 ? c : (bits & 1U) != 0 ? b : a;
    return ((bits & 4U) != 0 ? -first : first) + ((bits & 8U) != 0 ? -second : second);
  };
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const auto mixed = [](float a, float b, float part) { return a + (b - a) * part; };
  const float u = fade(in_cell.x), v = fade(in_cell.y), w = fade(in_cell.z);
  const auto row = [&](std::uint32_t j, std::uint32_t k) { return mixed(slope(0, j, k), slope(1, j, k), u); };
  return mixed(mixed(row(0, 0), row(1, 0), v), mixed(row(0, 1), row(1, 1), v), w);
}

/// As checker_kernel.h has it.
double mean_wave(double x, double wanted_width) {
  const double width = std::clamp(wanted_width, 1e-6, 1e6);
  const double half = std::floor(x), period = x - 2 * std::floor(x / 2);
  if (width < 1) {
    const double to_edge = 0.5 - std::abs(x - half - 0.5);
    return (period < 1 ? 1 : -1) * std::min(to_edge * 2 / width, 1.0);
  }
  const auto integral = [](double to) { return std::abs(to - 2 * std::floor(to / 2 + 0.5)); };
  return (integral(period + width / 2) - integral(period - width / 2)) / width;
}

TextureValue of_two_colors(const Rgb<double>& a, const Rgb<double>& b, double part) {
  return between({a.red, a.green, a.blue, 1}, {b.red, b.green, b.blue, 1}, part);
}

/// A place in an image, with how much of it counts.
struct InImage {
  Vec2d uv, across, along;
};

InImage in_image(const Image::Parameters& image, const TexturePlace::OnSurface& place) {
  const double angle = image.uvrotation * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const Vec2d& uv) {
    const double u = uv.x * image.uvscale.x, v = uv.y * image.uvscale.y;
    return Vec2d{c * u - s * v, s * u + c * v};
  };
  const Vec2d uv = turned(place.uv);
  return {{uv.x + image.uvoffset.x, uv.y + image.uvoffset.y}, turned({place.width.x, 0}), turned({0, place.width.y})};
}

/// None where there is no such tile.
std::optional<TextureValue> in_tile(const Image::Parameters& image, const TexelImage& texels, const InImage& place,
                                    double column, double row) {
  constexpr int columns = TexelImage::tile_columns;
  const auto rows = static_cast<double>(texels.tiles().size()) / columns;
  if (!(column >= 0 && column < columns && row >= 0 && row < rows)) return std::nullopt;
  const std::int32_t first = texels.tiles()[static_cast<std::size_t>(column + row * columns)];
  if (first < 0) return std::nullopt;
  const Vec2d in_it{place.uv.x - column, place.uv.y - row};
  return TexelReader(image, texels).at(in_it, place.across, place.along, first);
}

TextureValue value_in_image(const Image::Parameters& image, const TexelImage& texels, const InImage& place) {
  if (texels.tiles().empty()) return TexelReader(image, texels).at(place.uv, place.across, place.along, 0);
  return in_tile(image, texels, place, std::floor(place.uv.x), std::floor(place.uv.y)).value_or(TextureValue{});
}

TextureValue scaled_value(const Image::Parameters& image, TextureValue value, const TexturePlace& place) {
  if (image.vertexalpha) value = scaled_value(value, place.vertex_alpha, 0);
  return scaled_value(value, image.valuescale, image.valueoffset);
}

}  // namespace

TextureValue texture_value(const Image::Parameters& image, const TexelImage* texels, const TexturePlace& place) {
  TextureValue value{1, 0, 1, 1};
  if (texels != nullptr) value = value_in_image(image, *texels, in_image(image, place.by(image.uvset)));
  return scaled_value(image, value, place);
}

std::optional<TextureValue> height_value(const Image::Parameters& image, const TexelImage& texels,
                                         const TexturePlace& place) {
  const InImage at = in_image(image, place.by(image.uvset));
  if (texels.tiles().empty()) return scaled_value(image, value_in_image(image, texels, at), place);
  const double column = std::floor(at.uv.x), row = std::floor(at.uv.y);
  const int columns_back = at.uv.x == column ? 1 : 0, rows_back = at.uv.y == row ? 1 : 0;
  for (int i = 0; i <= columns_back; ++i)
    for (int j = 0; j <= rows_back; ++j)
      if (const auto value = in_tile(image, texels, at, column - i, row - j)) return scaled_value(image, *value, place);
  return std::nullopt;
}

TextureValue texture_value(const Checker::Parameters& checker, const TexturePlace& place) {
  double product = 1;
  if (checker.scale > 0) {
    const double frequency = 1 / std::max(checker.scale, smallest_size);
    for (const double x : {place.point.x, place.point.y, place.point.z})
      product *= mean_wave(x * frequency, place.width * frequency);
  } else {
    const auto& [uv, width] = place.by(checker.uvset);
    product = mean_wave(uv.x * checker.uvscale.x, std::abs(width.x * checker.uvscale.x)) *
              mean_wave(uv.y * checker.uvscale.y, std::abs(width.y * checker.uvscale.y));
  }
  return of_two_colors(checker.color1, checker.color2, 0.5 - 0.5 * product);
}

TextureValue texture_value(const Noise::Parameters& noise, const TexturePlace& place) {
  const Vec3f at(place.point);
  const auto width = static_cast<float>(place.width);
  float frequency = static_cast<float>(1 / noise.scale), strength = 0.5F, sum = 0;
  for (int octave = 0; octave < noise.octaves; ++octave, frequency *= 2, strength *= 0.5F) {
    const float visible = std::clamp(2 - 2 * width * frequency, 0.0F, 1.0F);
    if (!(visible > 0)) break;
    sum += gradient_noise_at(at * frequency + Vec3f(0.37F, 0.59F, 0.83F)) * visible * strength;
  }
  return of_two_colors(noise.color1, noise.color2, std::clamp(0.5 + double{sum}, 0.0, 1.0));
}

TextureValue texture_value(const VertexColor::Parameters& vertices, const TexturePlace& place) {
  const Rgb<double>& color = place.vertex_color;
  return scaled_value({color.red, color.green, color.blue, place.vertex_alpha}, vertices.valuescale,
                      vertices.valueoffset);
}

}  // namespace raytrace
