// Turns a film into the bytes of an image format, through OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <memory>
#include <string>

#include "raytrace/film/film.h"
#include "raytrace/output/image_file.h"
#include "raytrace/output/pixel_format.h"

namespace raytrace {

class ImageEncoder {
 public:
  /// For the format that the extension of `file` names. Throws OutputError if there is none.
  ImageEncoder(const std::string& file, const ImageFileSettings& settings);

  const PixelFormat& pixel_format() const { return pixels_; }

  /// Writes the picture to an open, empty file, and flushes it. Once only. Throws OutputError.
  Repairs encode(const Film& film, const ImageMetadata& metadata, std::FILE* destination);

 private:
  OIIO::ImageSpec image_spec(const Film& film, const ImageMetadata& metadata) const;
  Repairs write_pixels(const Film& film, const std::string& name, const OIIO::ImageSpec& spec);
  void check(bool done) const;
  [[noreturn]] void fail(const std::string& reason) const;

  std::string file_;  ///< for messages
  std::unique_ptr<OIIO::ImageOutput> writer_;
  PixelFormat pixels_;
};

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, CloseFile>;

/// A file in memory. Throws std::bad_alloc.
FileHandle open_memory_file();

}  // namespace raytrace
