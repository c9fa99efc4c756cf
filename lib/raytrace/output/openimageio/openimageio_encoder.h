// The formats that OpenImageIO writes, but for EXR and PNG.
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <vector>

#include "raytrace/output/file_handle.h"
#include "raytrace/output/image_encoder.h"
#include "raytrace/output/pixel_format.h"

namespace raytrace {

class OpenImageIOEncoder final : public ImageEncoder {
 public:
  /// extension: in lower case, with its dot. Throws OutputError.
  OpenImageIOEncoder(std::string file, const std::string& extension, const ImageFileSettings& settings);
  ~OpenImageIOEncoder() override;

  bool holds_float() const override { return type_ == OIIO::TypeFloat; }
  bool holds_alpha() const override { return is_tiff(); }
  bool is_for_display() const override { return pixels_.srgb; }
  void check_size(int width, int height) const override;
  void begin(const PictureExtent& extent, const std::vector<Channel>& channels, const ImageMetadata& metadata,
             std::FILE* destination) override;
  void write(const ImageBand& band) override;
  Repairs finish() override;

 private:
  class Proxy;

  bool is_tiff() const { return writer_->format_name() == std::string_view("tiff"); }
  void choose_pixels(const std::string& extension);
  OIIO::ImageSpec image_spec(const ImageMetadata& metadata) const;
  /// Runs it; where a failed write is the cause of its error, throws that instead.
  template <class Action>
  void guard(const Action& action);
  void check(bool done) const;

  std::string extension_;
  PictureExtent extent_;
  std::FILE* destination_ = nullptr;
  std::unique_ptr<Proxy> proxy_;  ///< the destination, for writers that take such a thing
  FileHandle memory_;             ///< to be copied there, for the others
  std::unique_ptr<OIIO::ImageOutput> writer_;
  OIIO::TypeDesc type_;  ///< of a stored channel
  PixelFormat pixels_;
};

}  // namespace raytrace
