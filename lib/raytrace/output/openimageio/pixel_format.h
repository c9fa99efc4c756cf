// What an image format holds of a pixel, and how radiance becomes that.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

#include "raytrace/film/film.h"
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

/// The film's rows [y0, y1), PixelFormat::channels floats a pixel, ready to be stored; `values` is overwritten.
void convert_rows(const Film& film, int y0, int y1, const PixelFormat& format, std::vector<float>& values,
                  Repairs& repairs);

}  // namespace raytrace
