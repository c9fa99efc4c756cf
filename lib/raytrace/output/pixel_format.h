// How formats other than EXR store a pixel, and how radiance becomes that.
#pragma once

#include <string>

#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// RGB or RGBA. By default a display format's: clamped to [0, 1] and encoded with the sRGB curve.
struct PixelFormat {
  bool alpha = false;
  bool srgb = true;  ///< with straight alpha: the colour is that of the covered part alone. Otherwise linear, and
                     ///< premultiplied as in EXR
  float lowest = 0, highest = 1;
  float gain = 1;  ///< of the linear colour

  int channels() const { return alpha ? 4 : 3; }
};

/// A display format's, with the settings' alpha and exposure.
PixelFormat display_format(const ImageFileSettings& settings);

/// The attribute of ImageFileSettings::exposure: absent where that is 0, and its text is empty then.
inline constexpr const char* exposure_keyword = "raytrace:exposure";
std::string exposure_text(double exposure);

/// OpenImageIO's linear_to_sRGB(), bit for bit.
float srgb_encoded(float linear);

/// Row `row` of the band, from its top, pixel by pixel; values: channels() for each pixel. Returns what was changed.
Repairs stored_row(const ImageBand& band, int row, const PixelFormat& format, float* values);

}  // namespace raytrace
