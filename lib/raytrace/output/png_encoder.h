// PNG files: RGB or RGBA of 8 or 16 bits, compressed row by row as bands come.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/output/image_encoder.h"
#include "raytrace/output/pixel_format.h"

namespace raytrace {

class PngEncoder final : public ImageEncoder {
 public:
  PngEncoder(std::string file, const ImageFileSettings& settings);
  ~PngEncoder() override;

  bool holds_alpha() const override { return true; }
  bool is_for_display() const override { return true; }
  void begin(const PictureExtent& extent, const std::vector<Channel>& channels, const ImageMetadata& metadata,
             std::FILE* destination) override;
  void write(const ImageBand& band) override;
  Repairs finish() override;

 private:
  struct OpenFile;
  /// Runs calls of libpng, whose errors are jumps: `calls` must make no object that has a destructor. Throws an
  /// OutputError with the true reason of a failure, or std::bad_alloc.
  template <class Calls>
  void guard(const Calls& calls);

  PixelFormat pixels_;
  std::vector<std::uint8_t> bytes_;  ///< of a band; kept from band to band
  std::unique_ptr<OpenFile> open_;
};

}  // namespace raytrace
