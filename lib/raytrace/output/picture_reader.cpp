// Which library reads a picture.
#include <array>
#include <new>
#include <utility>

#include "raytrace/output/openimageio_module.h"
#include "raytrace/output/picture_codecs.h"

namespace raytrace {
namespace {

constexpr std::string_view png_begin = "\x89PNG", jpeg_begin = "\xff\xd8";

FileHandle open_bytes(std::string_view bytes) {
  FileHandle file(fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb"));
  if (!file) throw std::bad_alloc();
  return file;
}

}  // namespace

std::unique_ptr<PictureReader> open_picture(const std::string& file) {
  FileHandle stream(std::fopen(file.c_str(), "rb"));
  if (!stream) throw PictureError("it cannot be read");
  std::array<char, png_begin.size()> begin{};
  const std::string_view read(begin.data(), std::fread(begin.data(), 1, begin.size(), stream.get()));
  std::rewind(stream.get());
  if (read.starts_with(png_begin)) return make_png_reader(std::move(stream));
  if (read.starts_with(jpeg_begin))
    if (auto reader = make_jpeg_reader(std::move(stream))) return reader;
  return make_openimageio_reader(file, {});
}

std::unique_ptr<PictureReader> open_encoded_picture(std::string_view bytes) {
  if (bytes.starts_with(png_begin)) return make_png_reader(open_bytes(bytes));
  if (!bytes.starts_with(jpeg_begin)) throw PictureError("it is neither PNG nor JPEG");
  if (auto reader = make_jpeg_reader(open_bytes(bytes))) return reader;
  return make_openimageio_reader("picture.jpg", bytes);
}

}  // namespace raytrace
