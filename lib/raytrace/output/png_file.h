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

}  // namespace raytrace
