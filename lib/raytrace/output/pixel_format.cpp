#include "raytrace/output/pixel_format.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace raytrace {

namespace {

/// The colour of a pixel, which `index` counts from the band's left upper one, row by row.
Pixel color_at(const ImageBand& band, std::size_t index) {
  const auto value = [&](std::size_t color) {
    if (band.half_colors != nullptr) return imath_half_to_float(band.half_colors[index * ImageBand::colors + color]);
    return std::get<std::vector<float>>(band.planes[color])[index];
  };
  return {value(0), value(1), value(2), value(3)};
}

/// factor: what finite radiance is multiplied by.
float stored(float radiance, float factor, const PixelFormat& format, Repairs& repairs) {
  if (!std::isfinite(radiance)) {
    ++repairs.not_finite;
    if (std::isnan(radiance)) return 0;
    return radiance > 0 ? format.highest : format.lowest;
  }
  const float clamped = std::clamp(radiance * factor, format.lowest, format.highest);
  if (format.srgb) return srgb_encoded(clamped);
  if (clamped < radiance) ++repairs.clamped;
  return clamped;
}

/// NaN, which no render gives, covers nothing.
float coverage(float alpha) { return alpha > 0 ? std::min(alpha, 1.0F) : 0.0F; }

}  // namespace

PixelFormat display_format(const ImageFileSettings& settings) {
  PixelFormat format;
  format.alpha = settings.transparent;
  format.gain = static_cast<float>(std::exp2(settings.exposure));
  return format;
}

std::string exposure_text(double exposure) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  if (exposure != 0) text << exposure;
  return text.str();
}

float srgb_encoded(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

Repairs stored_row(const ImageBand& band, int row, const PixelFormat& format, float* values) {
  Repairs repairs;
  const auto width = static_cast<std::size_t>(band.region.width());
  const std::size_t first = static_cast<std::size_t>(row) * width;
  for (std::size_t i = first; i < first + width; ++i) {
    const Pixel pixel = color_at(band, i);
    const float alpha = format.alpha ? coverage(pixel.alpha) : 1.0F;
    const bool straight = format.srgb && alpha < 1;
    const float factor = !straight ? format.gain : alpha > 0 ? format.gain / alpha : 0.0F;
    if (std::min({pixel.red, pixel.green, pixel.blue}) < format.lowest && format.lowest == 0) ++repairs.negative;
    for (const float radiance : {pixel.red, pixel.green, pixel.blue})
      *values++ = stored(radiance, factor, format, repairs);
    if (format.alpha) *values++ = alpha;
  }
  return repairs;
}

}  // namespace raytrace
