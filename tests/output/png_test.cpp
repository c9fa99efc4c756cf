// What is particular to PNG files.
#include <OpenImageIO/color.h>

#include <cstring>
#include <limits>

#include "pictures.h"
#include "raytrace/film/film_means.h"
#include "source_date_epoch.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

/// The file's chunk of that kind, without its frame; empty if there is none.
std::string chunk(const std::string& file, const std::string& kind) {
  const std::string bytes = bytes_of(file);
  const auto number = [&](std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes.at(at + i));
    return value;
  };
  for (std::size_t at = 8; at + 12 <= bytes.size(); at += 12 + number(at))
    if (bytes.substr(at + 4, 4) == kind) return bytes.substr(at + 8, number(at));
  return {};
}

/// The values, as integers, of a file that OpenImageIO makes of the picture's sRGB-encoded values.
template <class Integer>
std::vector<Integer> by_openimageio(const std::string& file, const FloatPicture& film, const OIIO::TypeDesc& type) {
  const int width = film.region().width(), height = film.region().height();
  std::vector<float> values;
  for (const Pixel& pixel : film.pixels())
    for (const float linear : {pixel.red, pixel.green, pixel.blue}) values.push_back(OIIO::linear_to_sRGB(linear));
  const auto output = OIIO::ImageOutput::create(file);
  output->open(file, OIIO::ImageSpec(width, height, 3, type));
  output->write_image(OIIO::TypeFloat, values.data());
  output->close();
  return integers<Integer>(file, type);
}

}  // namespace

TEST_CASE("PNG holds the very integers that OpenImageIO makes of all kinds of values") {
  const TemporaryFolder folder;
  // Every 339th float in [0, 1].
  FloatPicture film(1024, 1024, {0, 0, 1024, 1024});
  std::uint32_t bits = 0;
  const auto next = [&] {
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    bits = bits + 339 > 0x3F800000U ? 0x3F800000U : bits + 339;
    return value;
  };
  for (int y = 0; y < 1024; ++y)
    for (int x = 0; x < 1024; ++x) film.at(x, y) = {next(), next(), next(), 1};
  CHECK(film.at(1023, 1023).blue == 1);
  ImageFileSettings settings;
  write_image(folder.file("a.png"), film, {}, settings);
  CHECK(integers<std::uint8_t>(folder.file("a.png"), OIIO::TypeUInt8) ==
        by_openimageio<std::uint8_t>(folder.file("b.png"), film, OIIO::TypeUInt8));
  settings.bit_depth = 16;
  write_image(folder.file("a.png"), film, {}, settings);
  CHECK(integers<std::uint16_t>(folder.file("a.png"), OIIO::TypeUInt16) ==
        by_openimageio<std::uint16_t>(folder.file("b.png"), film, OIIO::TypeUInt16));
}

TEST_CASE("a PNG says that it is sRGB, and when it was made") {
  const SourceDateEpoch epoch("951868799");  // 2000-02-29 23:59:59
  const TemporaryFolder folder;
  const std::string file = folder.file("a.png");
  write_image(file, distinct_film(8, 8), some_metadata(), {});
  CHECK(chunk(file, "sRGB").size() == 1);
  CHECK(chunk(file, "gAMA") == std::string("\x00\x00\xb1\x8f", 4));  // 45455
  CHECK(chunk(file, "cHRM").size() == 32);
  CHECK(chunk(file, "tIME") == std::string("\x07\xd0\x02\x1d\x17\x3b\x3b", 7));
}

TEST_CASE("names beyond ASCII are UTF-8 text of their own kind") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.png");
  ImageMetadata metadata = some_metadata();
  metadata.scene_file = "caf\u00e9/\u4e16.xml";
  write_image(file, distinct_film(8, 8), metadata, {});
  CHECK(contains(chunk(file, "iTXt"), "raytrace:scene"));
  CHECK(read_picture(file).spec.get_string_attribute("raytrace:scene") == metadata.scene_file);
  metadata.scene_file = "no utf-8: \xff";
  write_image(file, distinct_film(8, 8), metadata, {});
  CHECK(chunk(file, "iTXt").empty());
}

TEST_CASE("bands of any height make the same PNG") {
  const SourceDateEpoch epoch("0");
  const TemporaryFolder folder;
  const FloatPicture film = noise_film(37, 50);
  ImageFileSettings settings;
  settings.bit_depth = GENERATE(8, 16);
  write_image(folder.file("a.png"), film, {}, settings);
  ImageFile image(folder.file("b.png"), film.extent(), color_channels(false), {}, settings);
  for (int y = 0; y < 50; y += 7) {
    ImageBand band;
    fill_color(band, film, y, std::min(y + 7, 50));
    image.write(band);
  }
  image.commit();
  CHECK(bytes_of(folder.file("b.png")) == bytes_of(folder.file("a.png")));
}

TEST_CASE("a film of half means can become a PNG, too") {
  const TemporaryFolder folder;
  FilmSettings settings;
  settings.extent = {5, 3, {0, 0, 5, 3}};
  Film film(settings, FilmContent::half_means);
  set_means(film, 2, 1, 1, [](int) { return Pixel{1, 0.5F, 0.25F, 1}; });
  write_image(folder.file("a.png"), film, {}, {});
  const ReadPicture picture = read_picture(folder.file("a.png"));
  CHECK(picture.value(2, 1, 0) == 1);
  CHECK(picture.value(2, 1, 1) == static_cast<float>(188) / 255);
  CHECK(picture.value(1, 1, 0) == 0);
}

TEST_CASE("in a transparent PNG, alpha is at most 1, and what is not finite is counted") {
  const TemporaryFolder folder;
  constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  FloatPicture film(3, 1, {0, 0, 3, 1});
  film.at(0, 0) = {infinity, nan, -infinity, 0.5F};
  film.at(1, 0) = {1, 1, 1, 2};
  film.at(2, 0) = {1e38F, 0, 1e-38F, 0x1p-31F};
  ImageFileSettings settings;
  settings.transparent = true;
  CHECK(write_image(folder.file("a.png"), film, {}, settings).not_finite == 3);
  CHECK(integers<std::uint8_t>(folder.file("a.png"), OIIO::TypeUInt8) ==
        std::vector<std::uint8_t>{255, 0, 0, 128, 255, 255, 255, 255, 255, 0, 0, 0});
}

}  // namespace raytrace::test
