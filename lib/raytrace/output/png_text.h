// What a PNG file says about itself.
#pragma once

#include <string>
#include <vector>

#include "raytrace/output/image_file.h"

namespace raytrace {

struct PngText {
  std::string keyword, text;
};

/// All as text, for PNG has no numbers. Throws OutputError if SOURCE_DATE_EPOCH is not a time.
std::vector<PngText> png_texts(const ImageMetadata& metadata, const ImageFileSettings& settings);

/// Of ImageFileSettings::exposure: absent where that is 0, and its text is empty then.
inline constexpr const char* exposure_keyword = "raytrace:exposure";
std::string exposure_text(double exposure);

}  // namespace raytrace
