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

/// TGA files begin with nothing that is always the same. This is whether it may be one: its first 18 bytes have the
/// kinds of its palette and pixels, and a size.
bool is_targa(std::string_view bytes) {
  if (bytes.size() <= 18) return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const unsigned palette = byte(1), kind = byte(2) & ~8U, bits = byte(16);  // 8: compressed
  return palette <= 1 && kind >= 1 && kind <= 3 && byte(2) < 16 && (kind != 1 || palette == 1) &&
         (byte(12) | byte(13)) > 0 && (byte(14) | byte(15)) > 0 &&
         (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32);
}

/// How OpenImageIO names a format that models of other programs have within them; empty: none.
std::string_view name_of_format(std::string_view bytes) {
  if (bytes.starts_with(jpeg_begin)) return "picture.jpg";
  if (bytes.starts_with("BM")) return "picture.bmp";
  if (bytes.starts_with("DDS ")) return "picture.dds";
  if (bytes.starts_with(std::string_view("II*\0", 4)) || bytes.starts_with(std::string_view("MM\0*", 4)))
    return "picture.tif";
  return is_targa(bytes) ? "picture.tga" : "";
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
  const std::string name(name_of_format(bytes));
  if (name.empty()) throw PictureError("it is neither PNG, nor JPEG, nor WebP, nor TGA, BMP, TIFF or DDS");
  if (bytes.starts_with(jpeg_begin))
    if (auto reader = make_jpeg_reader(open_bytes(bytes))) return reader;
  return make_openimageio_reader(name, bytes);
}

}  // namespace raytrace
