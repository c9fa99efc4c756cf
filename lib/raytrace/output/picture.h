// A picture that was read from a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "raytrace/memory/large_array.h"

namespace raytrace {

/// A file that is no picture, or not a whole one. What it says follows the file's name and a colon.
class PictureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a channel of a pixel is kept as: 0 to 255, 0 to 65535 or a floating-point number.
enum class TexelFormat : std::uint8_t { bytes, shorts, halves, floats };

inline std::size_t bytes_of(TexelFormat format) {
  return format == TexelFormat::bytes ? 1 : format == TexelFormat::floats ? 4 : 2;
}

/// What its pixels are.
struct PictureLayout {
  int width = 0, height = 0;
  int channels = 0;  ///< 1: grey; 4: red, green, blue and alpha, which does not multiply the others
  TexelFormat format = TexelFormat::bytes;

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels) * bytes_of(format);
  }
  std::size_t bytes() const { return row_bytes() * static_cast<std::size_t>(height); }
};

/// Rows from the top, without gaps.
struct Picture : PictureLayout {
  LargeArray<std::byte> pixels;
  bool has_alpha = false;  ///< whether the file has it; else it is 1
};

/// The largest picture that can be read: as many pixels as 16,384 times 16,384 has.
inline constexpr std::int64_t most_picture_pixels = std::int64_t{1} << 28;
inline constexpr int largest_picture_edge = 65536;

/// A picture of which nothing but the header has been read, so that its size is known before any memory follows from
/// it. Readers are independent of each other: several threads may each read one.
class PictureReader {
 public:
  PictureReader() = default;
  PictureReader(const PictureReader&) = delete;
  PictureReader& operator=(const PictureReader&) = delete;
  virtual ~PictureReader() = default;

  const PictureLayout& layout() const { return layout_; }
  /// Of all that is in memory at once while it is read: what it is made of as well.
  virtual std::uint64_t bytes_while_read() const { return layout_.bytes(); }
  /// All of it; to be called once. Throws PictureError or std::bad_alloc.
  virtual Picture read() = 0;

 protected:
  /// Throws PictureError if the size is none that can be read.
  void set_layout(const PictureLayout& layout);

 private:
  PictureLayout layout_;
};

/// Any format that OpenImageIO reads; PNG and most JPEG files without it. Throws PictureError, std::bad_alloc, or
/// OutputError if OpenImageIO is missing.
std::unique_ptr<PictureReader> open_picture(const std::string& file);

/// The same of the bytes of a PNG, JPEG, WebP, TGA, BMP, TIFF or DDS file, which stay for as long as the reader does.
std::unique_ptr<PictureReader> open_encoded_picture(std::string_view bytes);

}  // namespace raytrace
