#include "raytrace/output/openimageio/pixel_format.h"

#include <OpenImageIO/color.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytrace {

namespace {

float storable(float radiance, const PixelFormat& format, Repairs& repairs) {
  if (!std::isfinite(radiance)) {
    ++repairs.not_finite;
    if (std::isnan(radiance)) return 0;
    return radiance > 0 ? format.highest : format.lowest;
  }
  const float clamped = std::clamp(radiance, format.lowest, format.highest);
  if (format.srgb) return OIIO::linear_to_sRGB(clamped);
  if (clamped != radiance) ++repairs.clamped;
  return clamped;
}

}  // namespace

PixelFormat pixel_format(const std::string& oiio_name, const std::string& extension,
                         const ImageFileSettings& settings) {
  constexpr float largest_float = std::numeric_limits<float>::max();
  constexpr float largest_rgbe = 1.6e38F;  // 255/256 x 2^127, with room for its rounding

  if (oiio_name == "hdr") return {OIIO::TypeFloat, false, 0, largest_rgbe};
  if (extension == ".pfm" || (oiio_name == "tiff" && settings.full_float)) {
    return {OIIO::TypeFloat, false, -largest_float, largest_float};
  }
  return {settings.bit_depth == 16 ? OIIO::TypeUInt16 : OIIO::TypeUInt8, true, 0, 1};
}

std::vector<float> interleaved_rgb(const ImageBand& band, const PixelFormat& format, Repairs& repairs) {
  const auto& red = std::get<std::vector<float>>(band.planes[0]);
  const auto& green = std::get<std::vector<float>>(band.planes[1]);
  const auto& blue = std::get<std::vector<float>>(band.planes[2]);
  std::vector<float> values;
  values.reserve(red.size() * static_cast<std::size_t>(PixelFormat::channels));
  for (std::size_t i = 0; i < red.size(); ++i) {
    values.push_back(storable(red[i], format, repairs));
    values.push_back(storable(green[i], format, repairs));
    values.push_back(storable(blue[i], format, repairs));
  }
  return values;
}

}  // namespace raytrace
