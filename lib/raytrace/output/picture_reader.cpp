// Which library reads a picture.
#include <array>
#include <new>
#include <utility>

#include "raytrace/output/openimageio_module.h"
#include "raytrace/output/picture_codecs.h"

namespace raytrace {
namespace {

constexpr std::string_view png_begin = "\x89PNG", jpeg_begin = "\xff\xd8";

bool is_webp(std::string_view bytes) {
  return bytes.starts_with("RIFF") && bytes.size() >= 12 && bytes.substr(8).starts_with("WEBP");
}

/// Of a WebP file, which has less than 4 GiB.
std::string all_bytes(std::FILE* file) {
  const std::uint64_t size = file_size(file);
  if (size >> 32U != 0) throw PictureError("it is larger than a WebP file can be");
  std::string bytes(size, '\0');
  if (std::fread(bytes.data(), 1, bytes.size(), file) != bytes.size()) throw PictureError("it cannot be read");
  return bytes;
}

FileHandle open_bytes(std::string_view bytes) {
  FileHandle file(fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb"));
  if (!file) throw std::bad_alloc();
  return file;
}

}  // namespace

std::unique_ptr<PictureReader> open_picture(const std::string& file) {
  FileHandle stream(std::fopen(file.c_str(), "rb"));
  if (!stream) throw PictureError("it cannot be read");
  std::array<char, 12> begin{};
  const std::string_view read(begin.data(), std::fread(begin.data(), 1, begin.size(), stream.get()));
  std::rewind(stream.get());
  if (read.starts_with(png_begin)) return make_png_reader(std::move(stream));
  if (is_webp(read)) return make_webp_reader(all_bytes(stream.get()));
  if (read.starts_with(jpeg_begin))
    if (auto reader = make_jpeg_reader(std::move(stream))) return reader;
  return make_openimageio_reader(file, {});
}

std::unique_ptr<PictureReader> open_encoded_picture(std::string_view bytes) {
  if (bytes.starts_with(png_begin)) return make_png_reader(open_bytes(bytes));
  if (is_webp(bytes)) return make_webp_reader(std::string(bytes));
  if (!bytes.starts_with(jpeg_begin)) throw PictureError("it is neither PNG, nor JPEG, nor WebP");
  if (auto reader = make_jpeg_reader(open_bytes(bytes))) return reader;
  return make_openimageio_reader("picture.jpg", bytes);
}

}  // namespace raytrace
