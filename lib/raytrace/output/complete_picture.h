// Whether a picture need not be rendered again.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/film/film.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// What a file must hold to be the picture that is wanted. Of each format, what it keeps is compared.
struct WantedPicture {
  PictureExtent extent;                       ///< EXR: where in the picture; all others: the size
  Region light_paths_extent{};                ///< EXR: where in the picture, if it has light paths
  std::vector<Channel> channels;              ///< EXR: these, or more
  int bit_depth = 8;                          ///< PNG
  std::map<std::string, std::string> view{};  ///< PNG: names and values as `attributes` has them
  /// EXR and PNG: names and values, as text; "" for what the file must not have.
  std::map<std::string, std::string> attributes;
};

/// The file is a picture from its first row to its last, and is not marked as unfinished (attribute raytrace:partial in
/// EXR and PNG). Of EXR only the header and a row are read, of PNG the heads of its chunks; of a claim that is larger
/// than this program's pictures can be, nothing. An icon (.ico) never counts: OpenImageIO 2.4 writes past its memory
/// when it reads one.
bool is_complete_picture(const std::string& file);

/// ... and it is this picture.
bool is_complete_picture(const std::string& file, const WantedPicture& wanted);

/// What a PNG file says of itself, without its pixels.
struct PngFile {
  int width = 0, height = 0;
  int bits = 0;                              ///< of a channel
  std::map<std::string, std::string> texts;  ///< keyword -> text
};

/// None if it is no PNG, or not whole: if its chunks do not end with IEND. Compressed texts are passed over.
std::optional<PngFile> read_png_file(const std::string& file);

}  // namespace raytrace
