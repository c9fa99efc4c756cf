// OpenEXR files: scanlines of any channels, each of its own type, compressed in zip blocks.
#pragma once

#include <half.h>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/output/image_encoder.h"

namespace raytrace {

class ExrEncoder final : public ImageEncoder {
 public:
  ExrEncoder(std::string file, const ImageFileSettings& settings);
  ~ExrEncoder() override;

  bool holds_float() const override { return settings_.full_float; }
  bool holds_data() const override { return true; }
  bool holds_alpha() const override { return true; }
  bool is_for_display() const override { return false; }
  void begin(const PictureExtent& extent, const std::vector<Channel>& channels, const ImageMetadata& metadata,
             std::FILE* destination) override;
  void write(const ImageBand& band) override;
  Repairs finish() override;

 private:
  struct OpenFile;
  void convert_values(const ImageBand& band, std::size_t first_plane);
  const Imath::half* storable_colors(const ImageBand& band);
  /// Runs it, and throws an OutputError with the true reason for whatever it throws, or std::bad_alloc where that is
  /// it.
  template <class Action>
  void guard(const Action& action) const;

  std::unique_ptr<OpenFile> open_;
};

}  // namespace raytrace
