// What a PNG file says of itself, without its pixels.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace raytrace {

struct PngFile {
  int width = 0, height = 0;
  int bits = 0;                              ///< of a channel
  std::map<std::string, std::string> texts;  ///< keyword -> text
};

/// None if it is no PNG, or not whole: if its chunks do not end with IEND. Compressed texts are passed over.
std::optional<PngFile> read_png_file(const std::string& file);

/// Of ImageFileSettings::exposure: absent where that is 0, and its text is empty then.
inline constexpr const char* exposure_keyword = "raytrace:exposure";
std::string exposure_text(double exposure);

}  // namespace raytrace
