// What turns a picture into the bytes of an image format, band by band.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// begin(), write() from the picture's top to its bottom, finish(): once each, but for write(). All throw OutputError,
/// and the encoder is of no more use then. The destination may be destroyed only after the encoder.
class ImageEncoder {
 public:
  /// file: for messages.
  ImageEncoder(const std::string& file, const ImageFileSettings& settings) : file_(file), settings_(settings) {}
  virtual ~ImageEncoder() = default;
  ImageEncoder(const ImageEncoder&) = delete;
  ImageEncoder& operator=(const ImageEncoder&) = delete;

  virtual ImageFormat format() const = 0;

  /// Throws SizeError if the format cannot hold a picture of so many pixels. So does begin().
  virtual void check_size(int /*width*/, int /*height*/) const {}

  /// channels: color_channels() and any others, which are passed over by those that hold no data.
  /// destination: an open, empty file.
  virtual void begin(const PictureExtent& extent, const std::vector<Channel>& channels, const ImageMetadata& metadata,
                     std::FILE* destination) = 0;

  /// band: whole rows of the extent's region, the next below those written before, with a plane for each channel.
  virtual void write(const ImageBand& band) = 0;

  /// After the last row; empties the destination's buffer.
  virtual Repairs finish() = 0;

 protected:
  [[noreturn]] void fail(const std::string& reason) const {
    throw OutputError("cannot write " + file_ + ": " + reason);
  }
  /// Of the destination.
  [[noreturn]] void fail(int error_number) const { fail(std::generic_category().message(error_number)); }

  std::string file_;
  ImageFileSettings settings_;
  Repairs repairs_;
};

/// ".exr", in lower case; empty if the name has none.
std::string lower_extension(const std::string& file);

/// For the format that the extension of `file` names; the name itself is only for messages. Throws FormatError if there
/// is none, or if it cannot hold what the settings ask for.
std::unique_ptr<ImageEncoder> make_image_encoder(const std::string& file, const ImageFileSettings& settings);

/// Whatever the name. (exr_encoder.cpp, png_encoder.cpp)
std::unique_ptr<ImageEncoder> make_exr_encoder(const std::string& file, const ImageFileSettings& settings);
std::unique_ptr<ImageEncoder> make_png_encoder(const std::string& file, const ImageFileSettings& settings);

}  // namespace raytrace
