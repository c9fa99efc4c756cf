// The alpha of transparent pictures, and exposure, in the formats that have them.
#include <algorithm>
#include <cmath>

#include "pictures.h"
#include "raytrace/film/film_means.h"
#include "raytrace/math/srgb.h"
#include "raytrace/output/pixel_format.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

/// As files store a value of so many bits.
long code(float value, int bits) { return std::lround(static_cast<double>(value) * (bits == 8 ? 255 : 65535)); }

long encoded(double linear, int bits) {
  return code(srgb_of_linear(static_cast<float>(std::clamp(linear, 0.0, 1.0))), bits);
}

/// Straight alpha as it is stored; OpenImageIO would multiply the colour by it.
ReadPicture read_straight(const std::string& file) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  return read_picture(file, &config);
}

/// Premultiplied: nothing, a half, a quarter that is brighter than white, all.
FloatPicture covered_in_part() {
  FloatPicture film(4, 1, {0, 0, 4, 1});
  film.at(0, 0) = {0, 0, 0, 0};
  film.at(1, 0) = {0.25F, 0.1F, 0, 0.5F};
  film.at(2, 0) = {0.5F, 0.125F, 0.03F, 0.25F};
  film.at(3, 0) = {0.25F, 0.1F, 0.7F, 1};
  return film;
}

}  // namespace

TEST_CASE("PNG and TIFF hold straight alpha: the colour of the covered part, encoded") {
  const TemporaryFolder folder;
  const std::string file = folder.file(GENERATE("a.png", "a.tif"));
  ImageFileSettings settings;
  settings.transparent = true;
  settings.bit_depth = GENERATE(8, 16);
  settings.exposure = GENERATE(0.0, -1.0, 1.5);
  const int bits = settings.bit_depth;
  const FloatPicture film = covered_in_part();
  CHECK(write_image(file, film, {}, settings).clamped == 0);

  const ReadPicture picture = read_straight(file);
  REQUIRE(picture.spec.nchannels == 4);
  CHECK(picture.spec.alpha_channel == 3);
  if (contains(file, ".tif")) CHECK(picture.spec.get_int_attribute("oiio:UnassociatedAlpha") == 1);
  for (int x = 0; x < 4; ++x) {
    INFO(file << " column " << x);
    const Pixel& pixel = film.at(x, 0);
    CHECK(code(picture.value(x, 0, 3), bits) == code(pixel.alpha, bits));
    const std::array<float, 3> colors = {pixel.red, pixel.green, pixel.blue};
    for (int channel = 0; channel < 3; ++channel) {
      const double color =
          pixel.alpha > 0 ? double{colors[static_cast<std::size_t>(channel)]} / double{pixel.alpha} : 0;
      const long wanted = encoded(color * std::exp2(settings.exposure), bits);
      CHECK(std::abs(code(picture.value(x, 0, channel), bits) - wanted) <= (bits == 8 ? 0 : 1));
    }
  }
}

TEST_CASE("without alpha, a file holds the premultiplied colour: the picture over black") {
  const TemporaryFolder folder;
  const FloatPicture film = covered_in_part();
  ImageFileSettings settings;
  settings.transparent = true;
  const std::string bmp = folder.file("a.bmp"), png = folder.file("a.png");
  write_image(bmp, film, {}, settings);
  write_image(png, film, {}, {});
  for (const std::string& file : {bmp, png}) {
    const ReadPicture picture = read_picture(file);
    REQUIRE(picture.spec.nchannels == 3);
    CHECK(code(picture.value(1, 0, 0), 8) == encoded(0.25, 8));
    CHECK(code(picture.value(0, 0, 2), 8) == 0);
  }
}

TEST_CASE("a TIFF of floats holds premultiplied linear colour, which no exposure changes") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.tif");
  ImageFileSettings settings;
  settings.transparent = settings.full_float = true;
  settings.exposure = 3;
  const FloatPicture film = covered_in_part();
  write_image(file, film, some_metadata(), settings);
  const ReadPicture picture = read_straight(file);
  REQUIRE(picture.spec.nchannels == 4);
  CHECK(picture.spec.get_int_attribute("oiio:UnassociatedAlpha") == 0);
  for (int x = 0; x < 4; ++x) {
    CHECK(picture.value(x, 0, 0) == film.at(x, 0).red);
    CHECK(picture.value(x, 0, 3) == film.at(x, 0).alpha);
  }
  CHECK_FALSE(contains(picture.spec.get_string_attribute("ImageDescription").c_str(), "exposure"));
}

TEST_CASE("EXR has alpha in any case, and no exposure") {
  const TemporaryFolder folder;
  ImageFileSettings settings;
  settings.full_float = true;
  const FloatPicture film = covered_in_part();
  settings.transparent = GENERATE(false, true);
  settings.exposure = 2;
  write_image(folder.file("a.exr"), film, {}, settings);
  const ReadPicture picture = read_picture(folder.file("a.exr"));
  CHECK(picture.spec.nchannels == 4);
  CHECK(picture.value(2, 0, 0) == film.at(2, 0).red);
  CHECK(picture.value(2, 0, 3) == 0.25F);
  CHECK(picture.spec.find_attribute("raytrace:exposure") == nullptr);
}

TEST_CASE("exposure multiplies linear colour before it is clamped and encoded") {
  const TemporaryFolder folder;
  const std::string file = folder.file(GENERATE("a.png", "a.tif", "a.bmp"));
  ImageFileSettings settings;
  settings.exposure = GENERATE(-4.0, -1.5, 2.0);
  FloatPicture film(64, 1, {0, 0, 64, 1});
  for (int x = 0; x < 64; ++x) film.at(x, 0) = {static_cast<float>(x) / 16, static_cast<float>(x) / 640, 0, 1};
  write_image(file, film, some_metadata(), settings);
  const ReadPicture picture = read_picture(file);
  for (int x = 0; x < 64; ++x) {
    INFO(file << " column " << x);
    CHECK(std::abs(code(picture.value(x, 0, 0), 8) - encoded(x / 16.0 * std::exp2(settings.exposure), 8)) <= 0);
    CHECK(std::abs(code(picture.value(x, 0, 1), 8) - encoded(x / 640.0 * std::exp2(settings.exposure), 8)) <= 0);
  }
}

TEST_CASE("what was exposed says by how much") {
  const TemporaryFolder folder;
  ImageFileSettings settings;
  settings.exposure = -1.5;
  for (const char* name : {"a.png", "a.tif"})
    write_image(folder.file(name), distinct_film(4, 4), some_metadata(), settings);
  CHECK(read_picture(folder.file("a.png")).spec.get_string_attribute("raytrace:exposure") == "-1.5");
  CHECK(contains(read_picture(folder.file("a.tif")).spec.get_string_attribute("ImageDescription").c_str(),
                 "exposure -1.5"));
  write_image(folder.file("b.png"), distinct_film(4, 4), some_metadata(), {});
  CHECK(read_picture(folder.file("b.png")).spec.find_attribute("raytrace:exposure") == nullptr);
}

TEST_CASE("which files hold alpha, and which are for display") {
  ImageFileSettings floats;
  floats.full_float = true;
  for (const char* name : {"a.exr", "a.png", "a.PNG", "a.tif"}) CHECK(image_format(name).alpha);
  for (const char* name : {"a.jpg", "a.hdr", "a.bmp"}) CHECK_FALSE(image_format(name).alpha);
  for (const char* name : {"a.png", "a.tif", "a.jpg"}) CHECK(image_format(name).for_display);
  for (const char* name : {"a.exr", "a.hdr"}) CHECK_FALSE(image_format(name).for_display);
  CHECK(image_format("a.png", floats).for_display);
  CHECK_FALSE(image_format("a.tif", floats).for_display);
}

}  // namespace raytrace::test
