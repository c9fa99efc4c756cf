// Reads the EXR files that this program writes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "raytrace/cameras/camera_matrices.h"
#include "raytrace/film/film.h"
#include "raytrace/output/file_handle.h"
#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

class ExrReader {
 public:
  /// Throws InputError, as all of these: no such file, not an EXR such as this program writes, with windows of
  /// its sizes, or not whole. Memory and time follow from the file's own size, whatever it claims.
  explicit ExrReader(const std::string& file);
  ~ExrReader();
  ExrReader(ExrReader&&) noexcept;
  ExrReader& operator=(ExrReader&&) noexcept;

  const std::string& file() const { return file_; }

  /// The display window's size, and the data window.
  const PictureExtent& extent() const { return extent_; }

  /// In the order of their names, as the file has them.
  const std::vector<Channel>& channels() const { return channels_; }

  /// All attributes whose values are texts or numbers, and the camera's matrices.
  const std::vector<ImageAttribute>& attributes() const { return attributes_; }
  const CameraMatrices& camera() const { return camera_; }

  /// The attribute of that name, if there is one. Throws if it has another type.
  template <class Value>
  std::optional<Value> attribute(const std::string& name) const {
    for (const ImageAttribute& attribute : attributes_) {
      if (attribute.name != name) continue;
      if (const Value* value = std::get_if<Value>(&attribute.value)) return *value;
      refuse_type(name);
    }
    return std::nullopt;
  }

  /// The rows [y0, y1) of these channels, which the file must have, as it must have the rows.
  ImageBand read(const std::vector<Channel>& channels, int y0, int y1);

 private:
  struct OpenFile;
  [[noreturn]] void refuse_type(const std::string& attribute) const;
  std::string file_;
  std::unique_ptr<OpenFile> open_;
  PictureExtent extent_;
  std::vector<Channel> channels_;
  std::vector<ImageAttribute> attributes_;
  CameraMatrices camera_;
};

}  // namespace raytrace
