// PNG and JPEG pictures of all kinds, as OpenImageIO reads them.
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "raytrace/output/picture.h"

// clang-format off: it needs <cstdio>
#include <jpeglib.h>
// clang-format on

#include "raytrace/import/gltf_bytes.h"
#include "raytrace/output/file_handle.h"
#include "raytrace/output/openimageio_module.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {
namespace {

using namespace std::string_view_literals;

using Random = std::mt19937;

std::vector<std::uint8_t> random_bytes(Random& random, std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 24U);
  return bytes;
}

struct PngKind {
  int color, bits;
  bool interlaced, has_clear_color;
};

void write_png(const std::string& name, Random& random, unsigned width, unsigned height, const PngKind& kind) {
  const FileHandle file(std::fopen(name.c_str(), "wb"));
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  REQUIRE(setjmp(png_jmpbuf(png)) == 0);
  png_init_io(png, file.get());
  png_set_IHDR(png, info, width, height, kind.bits, kind.color, kind.interlaced ? PNG_INTERLACE_ADAM7 : 0, 0, 0);
  const unsigned colors = 1U << static_cast<unsigned>(std::min(kind.bits, 8));
  if (kind.color == PNG_COLOR_TYPE_PALETTE) {
    std::vector<png_color> palette(colors);
    for (png_color& color : palette)
      color = {static_cast<png_byte>(random() >> 24U), static_cast<png_byte>(random() >> 24U),
               static_cast<png_byte>(random() >> 24U)};
    png_set_PLTE(png, info, palette.data(), static_cast<int>(colors));
    const std::vector<std::uint8_t> alpha = random_bytes(random, colors / 2);
    if (kind.has_clear_color) png_set_tRNS(png, info, alpha.data(), static_cast<int>(alpha.size()), nullptr);
  } else if (kind.has_clear_color) {
    const auto value = static_cast<png_uint_16>(kind.bits == 16 ? 0x0303 : 1);
    png_color_16 clear{0, value, value, value, value};
    png_set_tRNS(png, info, nullptr, 0, &clear);
  }
  png_write_info(png, info);
  const std::size_t row_bytes = png_get_rowbytes(png, info);
  std::vector<std::uint8_t> pixels = random_bytes(random, row_bytes * height);
  // Few values, so that some pixels have the clear colour.
  if (kind.has_clear_color && kind.color != PNG_COLOR_TYPE_PALETTE && kind.bits >= 8)
    for (std::uint8_t& byte : pixels) byte = kind.bits == 16 ? 3 : byte & 1U;
  std::vector<png_bytep> rows;
  for (unsigned y = 0; y < height; ++y) rows.push_back(pixels.data() + y * row_bytes);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
}

void write_jpeg(const std::string& name, Random& random, unsigned width, unsigned height, J_COLOR_SPACE colors,
                bool progressive) {
  const FileHandle file(std::fopen(name.c_str(), "wb"));
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  jpeg_stdio_dest(&jpeg, file.get());
  jpeg.image_width = width;
  jpeg.image_height = height;
  jpeg.in_color_space = colors;
  jpeg.input_components = colors == JCS_GRAYSCALE ? 1 : colors == JCS_RGB ? 3 : 4;
  jpeg_set_defaults(&jpeg);
  if (progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row = random_bytes(random, width * static_cast<std::size_t>(jpeg.input_components));
  for (unsigned y = 0; y < height; ++y) {
    row[y % row.size()] = static_cast<std::uint8_t>(y);
    JSAMPROW rows = row.data();
    jpeg_write_scanlines(&jpeg, &rows, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
}

std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void check_same(const Picture& picture, const Picture& expected) {
  CHECK(picture.width == expected.width);
  CHECK(picture.height == expected.height);
  CHECK(picture.channels == expected.channels);
  CHECK(picture.format == expected.format);
  CHECK(picture.has_alpha == expected.has_alpha);
  REQUIRE(picture.bytes() == expected.bytes());
  CHECK(std::equal(picture.pixels.data(), picture.pixels.data() + picture.bytes(), expected.pixels.data()));
}

/// From its file and from memory.
void check_as_openimageio_reads_it(const std::string& file) {
  const Picture expected = make_openimageio_reader(file, {})->read();
  const auto reader = open_picture(file);
  CHECK(reader->layout().bytes() == expected.bytes());
  check_same(reader->read(), expected);
  const std::string bytes = file_bytes(file);
  check_same(open_encoded_picture(bytes)->read(), expected);
}

std::string reading_error(const std::string& file) {
  try {
    open_picture(file)->read();
  } catch (const PictureError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("PNG pictures of all kinds are as OpenImageIO reads them") {
  const TemporaryFolder folder;
  Random random(7);
  const std::vector<std::pair<int, std::vector<int>>> kinds = {{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                                                               {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                                                               {PNG_COLOR_TYPE_RGB, {8, 16}},
                                                               {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                                                               {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}};
  for (const auto& [color, depths] : kinds)
    for (const int bits : depths)
      for (const bool interlaced : {false, true})
        for (const bool has_clear_color : {false, true}) {
          if (has_clear_color && (color & PNG_COLOR_MASK_ALPHA) != 0) continue;
          CAPTURE(color, bits, interlaced, has_clear_color);
          write_png(folder.file("a.png"), random, 19, 11, {color, bits, interlaced, has_clear_color});
          check_as_openimageio_reads_it(folder.file("a.png"));
        }
}

TEST_CASE("JPEG pictures of all kinds are as OpenImageIO reads them") {
  const TemporaryFolder folder;
  Random random(8);
  for (const J_COLOR_SPACE colors : {JCS_GRAYSCALE, JCS_RGB, JCS_CMYK})
    for (const bool progressive : {false, true}) {
      CAPTURE(colors, progressive);
      write_jpeg(folder.file("a.jpg"), random, 37, 21, colors, progressive);
      check_as_openimageio_reads_it(folder.file("a.jpg"));
    }
}

TEST_CASE("WebP pictures are read, whose alpha does not multiply their colours") {
  // Of 4 x 3 pixels, without loss.
  const std::string bytes = *gltf::data_of_uri(
      "data:image/webp;base64,"
      "UklGRnoAAABXRUJQVlA4TG4AAAAvA4AAEF+gNACQJrITmc4JPADq/"
      "8lo9yA1AYA0zIuLpGQxjDlMsuerKJLUiOtJIQuNeEANAiARcFkwyDZS0e7M3uwPLczk7rp7fsROEPpHzS+bp27VSmdf/"
      "oD8QUEAMkwLGfRRRRt2Ykf0P0B9DA==");
  const std::vector<std::uint8_t> expected = {
      68, 32, 130, 255, 253, 230, 241, 64, 194, 107, 48,  128, 14,  199, 221, 64, 1,   228, 136, 64,  117, 52, 162, 255,
      11, 13, 4,   128, 110, 216, 14,  64, 113, 224, 253, 64,  119, 176, 118, 64, 112, 235, 148, 255, 213, 51, 95,  64};
  const TemporaryFolder folder;
  std::ofstream(folder.file("a.webp"), std::ios::binary) << bytes;
  const Picture picture = open_encoded_picture(bytes)->read();
  check_same(open_picture(folder.file("a.webp"))->read(), picture);
  CHECK(picture.width == 4);
  CHECK(picture.has_alpha);
  REQUIRE(picture.bytes() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(std::to_integer<int>(picture.pixels.data()[i]) == expected[i]);
  }
}

TEST_CASE("a picture's name may lie about its format") {
  const TemporaryFolder folder;
  Random random(9);
  write_jpeg(folder.file("a.png"), random, 8, 8, JCS_RGB, false);
  CHECK(open_picture(folder.file("a.png"))->read().channels == 4);
}

TEST_CASE("pictures that end too early are errors, wherever they end") {
  const TemporaryFolder folder;
  Random random(10);
  write_png(folder.file("a.png"), random, 64, 64, {PNG_COLOR_TYPE_RGB, 8, false, false});
  write_jpeg(folder.file("a.jpg"), random, 64, 64, JCS_RGB, false);
  std::ofstream(folder.file("cut"), std::ios::binary) << std::string("RIFF\x7a\0\0\0WEBPVP8L", 16);
  CHECK(reading_error(folder.file("cut")).find("truncated") != std::string::npos);
  for (const char* const name : {"a.png", "a.jpg"}) {
    const std::string whole = file_bytes(folder.file(name));
    // A PNG file's pixels end 16 bytes before the file does.
    for (std::size_t size = 8; size + 20 < whole.size(); size += 97) {
      CAPTURE(name, size);
      std::ofstream(folder.file("cut"), std::ios::binary) << whole.substr(0, size);
      CHECK(reading_error(folder.file("cut")).find("truncated") != std::string::npos);
    }
  }
}

TEST_CASE("BMP and TGA pictures are read from memory, where models have them") {
  const auto number = [](unsigned value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8U * static_cast<unsigned>(i)) & 255U);
    return text;
  };
  // Two pixels, blue before green before red: red and (10, 20, 30).
  const std::string pixels("\x00\x00\xff\x1e\x14\x0a", 6);
  const std::string bmp = "BM" + number(62, 4) + number(0, 4) + number(54, 4) + number(40, 4) + number(2, 4) +
                          number(1, 4) + number(1, 2) + number(24, 2) + number(0, 24) + pixels + number(0, 2);
  const std::string tga =
      number(0, 2) + number(2, 1) + number(0, 9) + number(2, 2) + number(1, 2) + number(24, 1) + number(0, 1) + pixels;
  for (const std::string& bytes : {bmp, tga}) {
    const Picture picture = open_encoded_picture(bytes)->read();
    CHECK(picture.width == 2);
    CHECK(picture.height == 1);
    REQUIRE(picture.bytes() == 8);
    const std::string_view read(reinterpret_cast<const char*>(picture.pixels.data()), 8);
    CHECK(read == "\xff\x00\x00\xff\x0a\x14\x1e\xff"sv);
  }
}

TEST_CASE("damaged pictures are errors, or pictures") {
  const TemporaryFolder folder;
  Random random(11);
  write_png(folder.file("a.png"), random, 40, 40, {PNG_COLOR_TYPE_PALETTE, 8, true, true});
  write_jpeg(folder.file("a.jpg"), random, 40, 40, JCS_RGB, true);
  int damaged = 0;
  for (const char* const name : {"a.png", "a.jpg"}) {
    const std::string whole = file_bytes(folder.file(name));
    for (int i = 0; i < 300; ++i) {
      std::string bytes = whole;
      bytes[8 + random() % (bytes.size() - 8)] = static_cast<char>(random());
      try {
        open_encoded_picture(bytes)->read();
      } catch (const PictureError& error) {
        ++damaged;
        CHECK(std::string(error.what()).size() > 10);
      }
    }
  }
  CHECK(damaged > 200);  // of PNG, whose chunks have checksums
}

TEST_CASE("a picture that says it is huge is refused before any memory follows from it") {
  const TemporaryFolder folder;
  Random random(12);
  write_png(folder.file("a.png"), random, 4, 4, {PNG_COLOR_TYPE_RGB, 8, false, false});
  std::string bytes = file_bytes(folder.file("a.png"));
  bytes.replace(16, 8, std::string("\x00\x00\xff\xff\x00\x00\xff\xff", 8));
  const auto checksum = static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + 12), 17));
  for (unsigned i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(checksum >> (24 - 8 * i));
  std::ofstream(folder.file("huge.png"), std::ios::binary) << bytes;
  CHECK(reading_error(folder.file("huge.png")) ==
        "it has 65535 x 65535 pixels; a texture has 16384 x 16384 at most, or as many");
}

}  // namespace raytrace::test
