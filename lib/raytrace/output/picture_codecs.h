// Readers of pictures of one format each.
#pragma once

#include <memory>
#include <string>

#include "raytrace/output/file_handle.h"
#include "raytrace/output/picture.h"

namespace raytrace {

/// Throws PictureError or std::bad_alloc.
std::unique_ptr<PictureReader> make_png_reader(FileHandle file);

/// Null for what only OpenImageIO reads: colours that are those of print.
std::unique_ptr<PictureReader> make_jpeg_reader(FileHandle file);

/// bytes: of the file.
std::unique_ptr<PictureReader> make_webp_reader(std::string bytes);

}  // namespace raytrace
