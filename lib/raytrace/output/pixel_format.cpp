#include "raytrace/output/pixel_format.h"

#include <half.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <utility>

#include "raytrace/math/blackbody.h"
#include "raytrace/math/srgb.h"
#include "raytrace/output/view_transform.h"

namespace raytrace {

namespace {

/// factor: what finite radiance is multiplied by.
float stored(float radiance, float factor, const PixelFormat& format, Repairs& repairs) {
  if (!std::isfinite(radiance)) {
    ++repairs.not_finite;
    if (std::isnan(radiance)) return 0;
    return radiance > 0 ? format.highest : format.lowest;
  }
  const float clamped = std::clamp(radiance * factor, format.lowest, format.highest);
  if (format.for_display) return srgb_of_linear(clamped);
  if (clamped < radiance) ++repairs.clamped;
  return clamped;
}

/// What a view transform takes of a part of a colour: NaN as black, infinity as the brightest that there is.
double viewed(float radiance, float factor, Repairs& repairs) {
  if (std::isfinite(radiance)) return double{radiance} * double{factor};
  ++repairs.not_finite;
  if (std::isnan(radiance)) return 0;
  return radiance > 0 ? double{std::numeric_limits<float>::max()} : 0;
}

/// Of an OpenColorIO configuration, only what it is to be given.
void view(const Pixel& pixel, float factor, const PixelFormat& format, float* values, Repairs& repairs) {
  Rgb<double> color{viewed(pixel.red, factor, repairs), viewed(pixel.green, factor, repairs),
                    viewed(pixel.blue, factor, repairs)};
  if (!format.ocio) color = view_transformed(format.view, color);
  for (const double part : {color.red, color.green, color.blue}) {
    const double most = format.ocio ? double{std::numeric_limits<float>::max()} : 1;
    const auto value = static_cast<float>(std::clamp(part, 0.0, most));
    *values++ = format.ocio ? value : srgb_of_linear(value);
  }
}

void apply_ocio(const PixelFormat& format, float* values, int pixels) {
  const int channels = format.channels();
  format.ocio->apply(values, pixels, channels);
  for (int i = 0; i < pixels; ++i)
    for (int part = 0; part < 3; ++part) {
      float& value = values[std::ptrdiff_t{i} * channels + part];
      value = value > 0 ? std::min(value, 1.0F) : 0;  // NaN is 0
    }
}

/// In [0, 1), of a pixel in the whole picture: spread so evenly that neighbours differ most (Jimenez, "Next Generation
/// Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014: interleaved gradient noise).
double threshold_at(int x, int y) {
  const auto fraction = [](double number) { return number - std::floor(number); };
  return fraction(52.9829189 * fraction(0.06711056 * x + 0.00583715 * y));
}

void dither(float* values, int pixels, int channels, int x, int y) {
  constexpr double most = 255;
  for (int i = 0; i < pixels; ++i) {
    const double threshold = threshold_at(x + i, y);
    for (int part = 0; part < 3; ++part) {
      float& value = values[std::ptrdiff_t{i} * channels + part];
      value = static_cast<float>(std::min(std::floor(double{value} * most + threshold), most) / most);
    }
  }
}

/// A colour that is not finite stays as it is.
Pixel balanced(const ColorMatrix& white_balance, const Pixel& pixel) {
  const Rgb<double> color = product(white_balance, {pixel.red, pixel.green, pixel.blue});
  if (!std::isfinite(color.red + color.green + color.blue)) return pixel;
  const auto stored = [](double part) {
    constexpr double most = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(part, -most, most));
  };
  return {stored(color.red), stored(color.green), stored(color.blue), pixel.alpha};
}

/// NaN, which no render gives, covers nothing.
float coverage(float alpha) { return alpha > 0 ? std::min(alpha, 1.0F) : 0.0F; }

}  // namespace

PixelFormat display_format(const ImageFileSettings& settings) {
  PixelFormat format;
  format.alpha = settings.transparent;
  format.gain = static_cast<float>(std::exp2(settings.exposure));
  format.view = settings.view_transform;
  if (settings.white_balance != 0) format.white_balance = white_balance(settings.white_balance);
  format.dithered = settings.dither && settings.bit_depth == 8;
  return format;
}

std::string shortest_text(double number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

std::vector<ImageAttribute> view_attributes(const ImageFileSettings& settings) {
  std::vector<ImageAttribute> attributes;
  if (!settings.ocio.empty()) {
    const OcioSettings& ocio = settings.ocio;
    std::string text = std::filesystem::path(ocio.config).filename().string();
    for (const auto& [label, name] :
         {std::pair{"display", ocio.display}, std::pair{"view", ocio.view}, std::pair{"colorspace", ocio.colorspace}})
      if (!name.empty()) text += std::string(" ") + label + "=" + name;
    attributes.push_back({ocio_keyword, text});
  } else if (settings.view_transform != ViewTransform::srgb) {
    attributes.push_back({view_transform_keyword, name_of(settings.view_transform)});
  }
  if (settings.exposure != 0) attributes.push_back({exposure_keyword, shortest_text(settings.exposure)});
  if (settings.white_balance != 0) attributes.push_back({white_balance_keyword, shortest_text(settings.white_balance)});
  if (settings.dither && settings.bit_depth == 8) attributes.push_back({dither_keyword, "1"});
  if (settings.auto_exposure) attributes.push_back({auto_exposure_keyword, shortest_text(*settings.auto_exposure)});
  return attributes;
}

Pixel color_at(const ImageBand& band, std::size_t index) {
  const auto value = [&](std::size_t color) {
    if (band.half_colors != nullptr) return imath_half_to_float(band.half_colors[index * ImageBand::colors + color]);
    return std::get<std::vector<float>>(band.planes[color])[index];
  };
  return {value(0), value(1), value(2), value(3)};
}

Repairs stored_row(const ImageBand& band, int row, const PixelFormat& format, float* values) {
  Repairs repairs;
  const auto width = static_cast<std::size_t>(band.region.width());
  float* const row_values = values;
  const bool is_viewed = format.for_display && (format.ocio || format.view != ViewTransform::srgb);
  const std::size_t first = static_cast<std::size_t>(row) * width;
  for (std::size_t i = first; i < first + width; ++i) {
    Pixel pixel = color_at(band, i);
    const float alpha = format.alpha ? coverage(pixel.alpha) : 1.0F;
    const bool straight = format.for_display && alpha < 1;
    const float factor = !straight ? format.gain : alpha > 0 ? format.gain / alpha : 0.0F;
    if (std::min({pixel.red, pixel.green, pixel.blue}) < format.lowest && format.lowest == 0) ++repairs.negative;
    if (format.white_balance) pixel = balanced(*format.white_balance, pixel);
    if (is_viewed) {
      view(pixel, factor, format, values, repairs);
      values += 3;
    } else {
      for (const float radiance : {pixel.red, pixel.green, pixel.blue})
        *values++ = stored(radiance, factor, format, repairs);
    }
    if (format.alpha) *values++ = alpha;
  }
  if (format.ocio) apply_ocio(format, row_values, band.region.width());
  if (format.dithered) dither(row_values, band.region.width(), format.channels(), band.region.x0, band.region.y0 + row);
  return repairs;
}

}  // namespace raytrace
