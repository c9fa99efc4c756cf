#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pictures.h"
#include "raytrace/film/film_means.h"
#include "source_date_epoch.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

ImageFileSettings float_settings() {
  ImageFileSettings settings;
  settings.full_float = true;
  return settings;
}

}  // namespace

TEST_CASE("EXR holds radiance and coverage as they are") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  const FloatPicture film = distinct_film(33, 21);
  const bool full_float = GENERATE(false, true);
  const Repairs repairs = write_image(file, film, {}, full_float ? float_settings() : ImageFileSettings{});

  const ReadPicture picture = read_picture(file);
  CHECK(repairs.clamped == 0);
  CHECK(repairs.not_finite == 0);
  CHECK(picture.spec.format == (full_float ? OIIO::TypeFloat : OIIO::TypeHalf));
  CHECK(picture.spec.channelnames == std::vector<std::string>{"R", "G", "B", "A"});
  CHECK(picture.spec.get_string_attribute("compression") == "zip");
  CHECK(picture.spec.tile_width == 0);
  REQUIRE(picture.spec.width == 33);
  REQUIRE(picture.spec.height == 21);
  int wrong = 0;
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 33; ++x) {
      const Pixel& pixel = film.at(x, y);
      wrong += picture.value(x, y, 0) != pixel.red;
      wrong += picture.value(x, y, 1) != pixel.green;
      wrong += picture.value(x, y, 2) != pixel.blue;
      wrong += picture.value(x, y, 3) != pixel.alpha;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("an EXR's data window is the region, its display window the whole picture") {
  const TemporaryFolder folder;
  const std::string file = folder.file("crop.exr");
  const FloatPicture film = distinct_film(64, 48, {5, 7, 25, 40});
  write_image(file, film, {}, {});

  const ReadPicture picture = read_picture(file);
  CHECK(picture.spec.x == 5);
  CHECK(picture.spec.y == 7);
  CHECK(picture.spec.width == 20);
  CHECK(picture.spec.height == 33);
  CHECK(picture.spec.full_x == 0);
  CHECK(picture.spec.full_y == 0);
  CHECK(picture.spec.full_width == 64);
  CHECK(picture.spec.full_height == 48);
  CHECK(picture.value(0, 0, 0) == film.at(5, 7).red);
  CHECK(picture.value(19, 32, 2) == film.at(24, 39).blue);
}

TEST_CASE("an EXR of several bands has no seams") {
  const TemporaryFolder folder;
  const std::string file = folder.file("wide.exr");
  constexpr int width = 40000, height = 70;  // more values than a band has
  FloatPicture film(width, height, {0, 0, width, height});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) film.at(x, y) = {static_cast<float>(y), static_cast<float>(x % 1024), 1, 1};
  }
  write_image(file, film, {}, {});

  const ReadPicture picture = read_picture(file);
  REQUIRE(picture.spec.height == height);
  std::size_t wrong = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      wrong +=
          picture.value(x, y, 0) != static_cast<float>(y) || picture.value(x, y, 1) != static_cast<float>(x % 1024);
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("a picture written in bands has the bytes of the same picture written at once") {
  const SourceDateEpoch epoch("86399");
  const TemporaryFolder folder;
  const std::string extension = GENERATE(".exr", ".png", ".tif", ".hdr", ".jpg");
  const std::string file = folder.file("a" + extension);
  const FloatPicture film = distinct_film(50, 90, {3, 5, 47, 88});
  write_image(file, film, {}, {});
  const std::string at_once = bytes_of(file);
  {
    ImageFile image(file, {50, 90, film.region()}, color_channels(false), {}, {});
    for (Region band = film.region(); band.y0 < 88; band.y0 = band.y1) {
      band.y1 = std::min(band.y0 + 32, 88);
      image.write(color_band(distinct_film(50, 90, band)));
      CHECK(bytes_of(file) == at_once);  // nothing is seen before the last
    }
    image.commit();
  }
  CHECK(bytes_of(file) == at_once);
}

TEST_CASE("a film of half means makes the same EXR as the sums that they are of") {
  const SourceDateEpoch epoch("86399");
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  FilmSettings settings;
  settings.extent = {40, 60, {3, 5, 37, 59}};
  settings.unit_exponent = -20;
  const bool too_bright = GENERATE(false, true);
  Film sums(settings);
  std::int64_t next = 1;
  for (int y = 5; y < 59; ++y)
    for (int x = 3; x < 37; ++x) {
      next = (next * 69069 + 1) % (std::int64_t{1} << 34);  // means up to 5461, in units of 2^-20
      sums.sum(x, y) = {next, next / 7, next / 1000, 1, 3};
    }
  if (too_bright) sums.sum(20, 30) = {std::int64_t{1} << 50, 0, -(std::int64_t{1} << 50), 1, 1};
  Film means(settings, FilmContent::half_means);
  for (int y = 5; y < 59; ++y)
    for (int x = 3; x < 37; ++x) set_means(means, x, y, 1, [&](int) { return sums.pixel(x, y); });

  const Repairs of_sums = write_image(file, sums, {}, {});
  const std::string wanted = bytes_of(file);
  const Repairs of_means = write_image(file, means, {}, {});
  CHECK(bytes_of(file) == wanted);
  CHECK(of_sums.clamped == (too_bright ? 2 : 0));
  CHECK(of_means.clamped == of_sums.clamped);
  CHECK(of_means.not_finite == of_sums.not_finite);
}

TEST_CASE("an EXR holds any channels, each of its type") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  const FloatPicture film = distinct_film(30, 50, {4, 6, 25, 48});
  std::vector<Channel> channels = color_channels(false);
  const std::vector<Channel> data = {{"Z", ChannelType::float32},
                                     {"id.object", ChannelType::uint32},
                                     {"a_layer_of_a_rather_long_name.R", ChannelType::half}};
  channels.insert(channels.end(), data.begin(), data.end());
  {
    ImageFile image(file, {30, 50, film.region()}, channels, {}, {});
    ImageBand band;
    for (int y0 = 6; y0 < 48; y0 = band.region.y1) {
      fill_color(band, film, y0, std::min(y0 + 32, 48));
      std::vector<float> depth, fraction;
      std::vector<std::uint32_t> id;
      for (std::uint32_t i = 0; i < 21U * static_cast<std::uint32_t>(band.region.height()); ++i) {
        depth.push_back(std::ldexp(16777215.0F, static_cast<int>(i % 100)));
        id.push_back(4294967295U - i);
        fraction.push_back(static_cast<float>(i % 64) / 64);
      }
      band.planes.resize(4);
      band.planes.insert(band.planes.end(), {depth, id, fraction});
      image.write(band);
    }
    const Repairs repairs = image.commit();
    CHECK(repairs.clamped == 0);
    CHECK(repairs.not_finite == 0);
  }

  Imf::InputFile exr(file.c_str());
  const Imath::Box2i window = exr.header().dataWindow();
  const auto type_of = [&](const char* name) { return exr.header().channels()[name].type; };
  CHECK(type_of("R") == Imf::HALF);
  CHECK(type_of("Z") == Imf::FLOAT);
  CHECK(type_of("id.object") == Imf::UINT);
  CHECK(type_of("a_layer_of_a_rather_long_name.R") == Imf::HALF);
  std::vector<float> red(21U * 42), depth(21U * 42);
  std::vector<std::uint32_t> id(21U * 42);
  Imf::FrameBuffer frame;
  frame.insert("R", Imf::Slice::Make(Imf::FLOAT, red.data(), window));
  frame.insert("Z", Imf::Slice::Make(Imf::FLOAT, depth.data(), window));
  frame.insert("id.object", Imf::Slice::Make(Imf::UINT, id.data(), window));
  exr.setFrameBuffer(frame);
  exr.readPixels(6, 47);
  int wrong = 0;
  for (std::uint32_t i = 0; i < red.size(); ++i) {
    const std::uint32_t in_band = i % (21U * 32);
    wrong += red[i] != film.at(4 + static_cast<int>(i % 21), 6 + static_cast<int>(i / 21)).red;
    wrong += depth[i] != std::ldexp(16777215.0F, static_cast<int>(in_band % 100));
    wrong += id[i] != 4294967295U - in_band;
  }
  CHECK(wrong == 0);
}

TEST_CASE("formats without further channels store the colours of them") {
  const SourceDateEpoch epoch("86399");
  const TemporaryFolder folder;
  const std::string extension = GENERATE(".png", ".tif", ".hdr");
  const FloatPicture film = distinct_film(9, 7);
  write_image(folder.file("a" + extension), film, {}, {});
  std::vector<Channel> channels = color_channels(false);
  channels.push_back({"Z", ChannelType::float32});
  ImageBand band;
  fill_color(band, film, 0, 7);
  band.planes.emplace_back(std::vector<float>(63, 1e30F));
  ImageFile image(folder.file("b" + extension), {9, 7, film.region()}, channels, {}, {});
  image.write(band);
  image.commit();
  CHECK(bytes_of(folder.file("b" + extension)) == bytes_of(folder.file("a" + extension)));
}

TEST_CASE("a picture that is not ended leaves nothing") {
  const TemporaryFolder folder;
  const std::string file = folder.file(GENERATE("a.exr", "a.png", "a.tif"));
  {
    ImageFile image(file, {40, 64, {0, 0, 40, 64}}, color_channels(false), {}, {});
    image.write(color_band(distinct_film(40, 64, {0, 0, 40, 32})));
  }
  CHECK(folder.names().empty());
}

TEST_CASE("what half cannot hold becomes its largest number, and is counted") {
  const TemporaryFolder folder;
  const std::string file = folder.file("bright.exr");
  FloatPicture film(4, 1, {0, 0, 4, 1});
  film.at(0, 0) = {65504, 65505, 1e30F, 1};
  film.at(1, 0) = {-1e30F, -65504, 0, 0};
  const Repairs half = write_image(file, film, {}, {});
  const ReadPicture stored = read_picture(file);
  CHECK(half.clamped == 3);
  CHECK(half.not_finite == 0);
  CHECK(stored.value(0, 0, 0) == 65504);
  CHECK(stored.value(0, 0, 1) == 65504);
  CHECK(stored.value(0, 0, 2) == 65504);
  CHECK(stored.value(1, 0, 0) == -65504);

  const Repairs full = write_image(file, film, {}, float_settings());
  CHECK(full.clamped == 0);
  CHECK(read_picture(file).value(0, 0, 2) == 1e30F);
}

TEST_CASE("no NaN and no infinity reaches a file") {
  const TemporaryFolder folder;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  FloatPicture film(2, 1, {0, 0, 2, 1});
  film.at(0, 0) = {std::nanf(""), infinity, -infinity, 1};
  film.at(1, 0) = {1, 1, 1, std::nanf("")};

  const std::string exr = folder.file("a.exr");
  CHECK(write_image(exr, film, {}, {}).not_finite == 4);
  const ReadPicture half = read_picture(exr);
  CHECK(half.value(0, 0, 0) == 0);
  CHECK(half.value(0, 0, 1) == 65504);
  CHECK(half.value(0, 0, 2) == -65504);
  CHECK(half.value(1, 0, 3) == 0);

  CHECK(write_image(exr, film, {}, float_settings()).not_finite == 4);
  CHECK(read_picture(exr).value(0, 0, 1) == std::numeric_limits<float>::max());

  const std::string png = folder.file("a.png");
  CHECK(write_image(png, film, {}, {}).not_finite == 3);  // no alpha
  const ReadPicture eight = read_picture(png);
  CHECK(eight.value(0, 0, 0) == 0);
  CHECK(eight.value(0, 0, 1) == 1);
  CHECK(eight.value(0, 0, 2) == 0);
}

}  // namespace raytrace::test
