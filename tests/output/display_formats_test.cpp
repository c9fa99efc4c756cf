// Formats that hold the picture for eyes rather than for calculation: clamped and sRGB-encoded.
#include <algorithm>
#include <cmath>

#include "pictures.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

/// IEC 61966-2-1, in double and written again.
double srgb_of(double linear) {
  linear = std::min(1.0, std::max(0.0, linear));
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Reds from below 0 to above 1, most of them dark.
FloatPicture ramp(int width) {
  FloatPicture film(width, 1, {0, 0, width, 1});
  for (int x = 0; x < width; ++x) {
    const double t = 1.1 * x / (width - 1) - 0.05;
    film.at(x, 0) = {static_cast<float>(t * std::abs(t)), 0.5F, 1, 0};
  }
  return film;
}

}  // namespace

TEST_CASE("PNG and TIFF hold the sRGB curve, rounded to the nearest step") {
  const TemporaryFolder folder;
  const std::string extension = GENERATE(".png", ".tif");
  const int bits = GENERATE(8, 16);
  const std::string file = folder.file("ramp" + extension);
  constexpr int width = 5000;
  const FloatPicture film = ramp(width);
  ImageFileSettings settings;
  settings.bit_depth = bits;
  const Repairs repairs = write_image(file, film, {}, settings);
  CHECK(repairs.clamped == 0);  // clamping is what such a file is

  const ReadPicture picture = read_picture(file);
  CHECK(picture.spec.format == (bits == 8 ? OIIO::TypeUInt8 : OIIO::TypeUInt16));
  CHECK(picture.spec.nchannels == 3);
  REQUIRE(picture.spec.width == width);
  const double steps = bits == 8 ? 255 : 65535;
  double worst = 0;
  for (int x = 0; x < width; ++x) {
    const double wanted = srgb_of(static_cast<double>(film.at(x, 0).red)) * steps;
    worst = std::max(worst, std::abs(static_cast<double>(picture.value(x, 0, 0)) * steps - wanted));
  }
  CHECK(worst <= (bits == 8 ? 0.501 : 0.52));  // half a step, and float's share
  CHECK(std::lround(static_cast<double>(picture.value(0, 0, 1)) * steps) == std::lround(srgb_of(0.5) * steps));
  CHECK(picture.value(0, 0, 2) == 1);
}

TEST_CASE("a file for eyes is just the region") {
  const TemporaryFolder folder;
  const std::string file = folder.file("crop.png");
  const FloatPicture film = distinct_film(64, 48, {5, 7, 25, 40});
  write_image(file, film, {}, {});
  const ReadPicture picture = read_picture(file);
  CHECK(picture.spec.x == 0);
  CHECK(picture.spec.y == 0);
  CHECK(picture.spec.full_width == 20);
  CHECK(picture.spec.full_height == 33);
  CHECK(std::abs(static_cast<double>(picture.value(19, 32, 0)) - srgb_of(24.0 / 64)) <= 0.51 / 255);
}

TEST_CASE("HDR holds linear radiance, to the eight bits of its mantissa") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.hdr");
  FloatPicture film(8, 8, {0, 0, 8, 8});
  film.at(3, 2) = {1000, 500, 250, 1};
  write_image(file, film, {}, {});
  const ReadPicture picture = read_picture(file);
  CHECK(std::abs(picture.value(3, 2, 0) - 1000) < 10);
  CHECK(std::abs(picture.value(3, 2, 2) - 250) < 10);  // the exponent is the largest channel's
  CHECK(picture.value(0, 0, 0) == 0);
}

TEST_CASE("TIFF holds linear floats where they are asked for") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.tif");
  ImageFileSettings settings;
  settings.full_float = true;
  const FloatPicture film = distinct_film(40, 30);
  write_image(file, film, some_metadata(), settings);
  const ReadPicture picture = read_picture(file);
  CHECK(picture.spec.format == OIIO::TypeFloat);
  CHECK(picture.value(39, 29, 0) == film.at(39, 29).red);
}

TEST_CASE("other formats work by their extension, in any case") {
  const TemporaryFolder folder;
  const std::string extension = GENERATE(".jpg", ".JPEG", ".PNG", ".bmp", ".tga", ".ppm", ".sgi", ".TIFF");
  const std::string file = folder.file("a" + extension);
  const FloatPicture film = distinct_film(48, 40);
  check_format(file, {});
  write_image(file, film, some_metadata(), {});
  const ReadPicture picture = read_picture(file);
  REQUIRE(picture.spec.width == 48);
  REQUIRE(picture.spec.height == 40);
  double error = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      error += std::abs(static_cast<double>(picture.value(x, y, 0)) - srgb_of(static_cast<double>(film.at(x, y).red)));
    }
  }
  CHECK(error / (48 * 40) < 0.01);  // JPEG loses some
}

TEST_CASE("an extension or a bit depth that no file can have is reported before the render") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, int bits) {
    ImageFileSettings settings;
    settings.bit_depth = bits;
    try {
      check_format(folder.file(name), settings);
    } catch (const OutputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(contains(message("a.exrr", 8), "a.exrr"));
  CHECK(contains(message("a.exrr", 8), "did you mean '.exr'?"));
  CHECK(contains(message("a.pgn", 8), "did you mean '.png'?"));
  CHECK(contains(message("a.psd", 8), "read but not written"));
  CHECK(contains(message("a", 8), "no extension"));
  CHECK(contains(message("a.", 8), "no extension"));
  CHECK(contains(message("a.term", 8), ".term"));  // OpenImageIO would draw on the terminal
  CHECK(contains(message("a.jpg", 16), "8 bits a channel, not 16"));
  CHECK(message("a.png", 16).empty());
  CHECK(message("a.exr", 16).empty());
  CHECK(folder.names().empty());
}

TEST_CASE("which files can hold floats") {
  ImageFileSettings floats;
  floats.full_float = true;
  CHECK(image_format("a.exr", floats).floats);
  CHECK(image_format("a.tif", floats).floats);
  CHECK(image_format("a.hdr", floats).floats);
  CHECK_FALSE(image_format("a.png", floats).floats);
  CHECK_THROWS_AS(image_format("a.unknown", floats), OutputError);
}

TEST_CASE("which files want no more than halves") {
  ImageFileSettings floats;
  floats.full_float = true;
  CHECK(image_format("a.exr", {}).halves());
  CHECK_FALSE(image_format("a.exr", floats).halves());
  CHECK_FALSE(image_format("a.png", {}).halves());
  CHECK_FALSE(image_format("a.hdr", {}).halves());
  CHECK_THROWS_AS(image_format("a.unknown", {}), OutputError);
}

}  // namespace raytrace::test
