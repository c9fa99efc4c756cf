// How formats other than EXR store a pixel, and how radiance becomes that.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/math/color_matrix.h"
#include "raytrace/output/color_transform.h"
#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// RGB or RGBA. By default a display format's: clamped to [0, 1] and encoded with the sRGB curve.
struct PixelFormat {
  bool alpha = false;
  bool for_display = true;  ///< with straight alpha: the colour is that of the covered part alone. Otherwise linear,
                            ///< and premultiplied as in EXR
  float lowest = 0, highest = 1;
  float gain = 1;  ///< of the linear colour
  // Of display formats.
  std::optional<ColorMatrix> white_balance{};
  ViewTransform view = ViewTransform::srgb;
  std::shared_ptr<const ColorTransform> ocio{};  ///< null, or in place of the view transform and the curve
  /// Colours are multiples of 1/255: each the one below or above, by a pattern that has the colour as its mean.
  bool dithered = false;

  int channels() const { return alpha ? 4 : 3; }
};

/// A display format's, with the settings' alpha, exposure, white balance and view transform, but without OpenColorIO,
/// which is the module's (openimageio_module.h).
PixelFormat display_format(const ImageFileSettings& settings);

inline constexpr const char* view_transform_keyword = "raytrace:viewTransform";
inline constexpr const char* exposure_keyword = "raytrace:exposure";
inline constexpr const char* auto_exposure_keyword = "raytrace:autoExposure";
inline constexpr const char* white_balance_keyword = "raytrace:whiteBalance";
inline constexpr const char* ocio_keyword = "raytrace:ocio";
inline constexpr const char* dither_keyword = "raytrace:dither";

/// As short as it can be without being another number.
std::string shortest_text(double number);

/// What a file for display says of the settings' view: only of what is not the default. What the picture's own
/// brightness asked for, and what was asked for beside it, are two.
std::vector<ImageAttribute> view_attributes(const ImageFileSettings& settings);

/// The colour of a pixel, which `index` counts from the band's left upper one, row by row.
Pixel color_at(const ImageBand& band, std::size_t index);

/// Row `row` of the band, from its top, pixel by pixel; values: channels() for each pixel. Returns what was changed.
Repairs stored_row(const ImageBand& band, int row, const PixelFormat& format, float* values);

}  // namespace raytrace
