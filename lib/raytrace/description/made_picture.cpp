#include "raytrace/description/made_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "raytrace/math/srgb.h"

namespace raytrace {
namespace {

std::byte as_byte(double number) { return static_cast<std::byte>(std::lround(std::clamp(number, 0.0, 1.0) * 255)); }

struct SourcePixel {
  Rgb<double> color;  ///< in linear light
  double alpha;

  SourcePixel mixed(const SourcePixel& other, double part) const {
    return {color * (1 - part) + other.color * part, alpha * (1 - part) + other.alpha * part};
  }
};

/// A picture of sRGB's numbers, or all white.
class SourcePicture {
 public:
  SourcePicture() = default;
  explicit SourcePicture(Picture picture) : picture_(std::move(picture)) {
    if (picture_->format != TexelFormat::bytes && picture_->format != TexelFormat::shorts)
      throw PictureError("its numbers are floating-point ones, and not sRGB's");
    light_.resize(picture_->format == TexelFormat::bytes ? 256 : 65536);
    for (std::size_t i = 0; i < light_.size(); ++i)
      light_[i] = linear_of_srgb(static_cast<double>(i) / static_cast<double>(light_.size() - 1));
  }

  /// In the middle of a pixel of a picture of that size.
  SourcePixel at(int column, int row, const PictureLayout& of) const {
    if (!picture_) return {{1, 1, 1}, 1};
    if (of.width == picture_->width && of.height == picture_->height) return pixel(column, row);
    const double x = (column + 0.5) * picture_->width / of.width - 0.5;
    const double y = (row + 0.5) * picture_->height / of.height - 0.5;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    const auto in_row = [&](int i) { return pixel(left, i).mixed(pixel(left + 1, i), x - left); };
    return in_row(top).mixed(in_row(top + 1), y - top);
  }

 private:
  SourcePixel pixel(int column, int row) const {
    const auto x = static_cast<std::size_t>(std::clamp(column, 0, picture_->width - 1));
    const auto y = static_cast<std::size_t>(std::clamp(row, 0, picture_->height - 1));
    const auto channels = static_cast<std::size_t>(picture_->channels);
    const std::size_t first = (y * static_cast<std::size_t>(picture_->width) + x) * channels;
    const double red = light_[code(first)];
    if (channels == 1) return {{red, red, red}, 1};
    return {{red, light_[code(first + 1)], light_[code(first + 2)]},
            static_cast<double>(code(first + 3)) / static_cast<double>(light_.size() - 1)};
  }
  std::size_t code(std::size_t i) const {
    if (picture_->format == TexelFormat::bytes) return std::to_integer<std::size_t>(picture_->pixels.data()[i]);
    std::uint16_t number = 0;
    std::memcpy(&number, picture_->pixels.data() + i * sizeof number, sizeof number);
    return number;
  }

  std::optional<Picture> picture_;
  std::vector<double> light_;  ///< of a code
};

class MadePicture : public PictureReader {
 public:
  explicit MadePicture(const SpecularGlossiness& from)
      : from_(from), diffuse_(opened(from.diffuse)), specular_(opened(from.specular)) {
    PictureLayout layout{1, 1, 4, TexelFormat::bytes};
    for (const auto* reader : {&diffuse_, &specular_})
      if (*reader) {
        layout.width = std::max(layout.width, (*reader)->layout().width);
        layout.height = std::max(layout.height, (*reader)->layout().height);
      }
    set_layout(layout);
  }

  std::uint64_t bytes_while_read() const override {
    std::uint64_t bytes = layout().bytes();
    for (const auto* reader : {&diffuse_, &specular_})
      if (*reader) bytes += (*reader)->bytes_while_read();
    return bytes;
  }

  Picture read() override {
    const SourcePicture diffuse = taken(diffuse_, from_.diffuse), specular = taken(specular_, from_.specular);
    Picture made{layout(), LargeArray<std::byte>::zeros(layout().bytes()), false};
    std::byte* at = made.pixels.data();
    for (int row = 0; row < made.height; ++row)
      for (int column = 0; column < made.width; ++column) {
        const SourcePixel mirrored = specular.at(column, row, made);
        const MetalShare share = metal_share(diffuse.at(column, row, made).color * from_.diffuse_factor,
                                             mirrored.color * from_.specular_factor);
        const auto& [red, green, blue] = share.base_color;
        const std::array<double, 4> numbers =
            from_.is_color
                ? std::array{srgb_of_linear(red), srgb_of_linear(green), srgb_of_linear(blue), 1.0}
                : std::array{share.specular_weight, 1 - mirrored.alpha * from_.glossiness_factor, share.metalness, 1.0};
        for (const double number : numbers) *at++ = as_byte(number);
      }
    return made;
  }

 private:
  static std::unique_ptr<PictureReader> opened(const SpecularGlossiness::Source& source) {
    if (source.file.empty() && !source.bytes) return nullptr;
    return naming(source,
                  [&] { return source.bytes ? open_encoded_picture(*source.bytes) : open_picture(source.file); });
  }
  static SourcePicture taken(std::unique_ptr<PictureReader>& reader, const SpecularGlossiness::Source& source) {
    if (!reader) return {};
    return naming(source, [&] { return SourcePicture(std::exchange(reader, nullptr)->read()); });
  }

  const SpecularGlossiness& from_;
  std::unique_ptr<PictureReader> diffuse_, specular_;
};

}  // namespace

std::unique_ptr<PictureReader> open_made_picture(const SpecularGlossiness& from) {
  return std::make_unique<MadePicture>(from);
}

}  // namespace raytrace
