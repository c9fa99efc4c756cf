// What an image format holds of a pixel, and how radiance becomes that.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

struct PixelFormat {
  static constexpr int channels = 3;  ///< RGB
  OIIO::TypeDesc type;                ///< of a stored channel
  bool srgb;                          ///< [0, 1] and the sRGB curve; otherwise linear
  float lowest, highest;
};

/// oiio_name: OpenImageIO's name of the format ("png"); extension: in lower case, with its dot.
PixelFormat pixel_format(const std::string& oiio_name, const std::string& extension, const ImageFileSettings& settings);

/// The band's first three planes, R, G and B, as floats that are ready to be stored, pixel by pixel.
std::vector<float> interleaved_rgb(const ImageBand& band, const PixelFormat& format, Repairs& repairs);

}  // namespace raytrace
