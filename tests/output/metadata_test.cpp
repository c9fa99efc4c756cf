#include "pictures.h"
#include "source_date_epoch.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

bool has(const OIIO::ImageSpec& spec, const char* name) { return spec.find_attribute(name) != nullptr; }

}  // namespace

TEST_CASE("EXR metadata is typed and has OpenEXR's standard names") {
  const SourceDateEpoch unset(nullptr);
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  ImageMetadata metadata = some_metadata();
  metadata.attributes = {{"cryptomatte/0123456/conversion", std::string("uint32_to_float32")},
                         {"raytrace:tile", 7},
                         {"raytrace:an attribute with a longer name", 0.1F}};
  write_image(file, distinct_film(8, 8), metadata, {});

  const OIIO::ImageSpec spec = read_picture(file).spec;
  CHECK(spec.get_string_attribute("Software") == "raytrace 1.2.3");
  CHECK(spec.get_string_attribute("raytrace:scene") == "folder/scene.xml");
  CHECK(spec.get_int_attribute("raytrace:samples") == 16);
  CHECK(spec.get_string_attribute("raytrace:seed") == "18446744073709551615");
  CHECK(spec.get_int_attribute("raytrace:threads") == 3);
  CHECK(spec.get_float_attribute("raytrace:renderSeconds") == 12.5F);
  CHECK(spec.get_string_attribute("DateTime").size() == 19);
  CHECK(spec.get_string_attribute("cryptomatte/0123456/conversion") == "uint32_to_float32");
  CHECK(spec.get_int_attribute("raytrace:tile") == 7);
  CHECK(spec.get_float_attribute("raytrace:an attribute with a longer name") == 0.1F);

  const auto* const camera = spec.find_attribute("worldToCamera", OIIO::TypeMatrix);
  const auto* const ndc = spec.find_attribute("worldToNDC", OIIO::TypeMatrix);
  REQUIRE(camera != nullptr);
  REQUIRE(ndc != nullptr);
  for (int i = 0; i < 16; ++i) {
    CHECK(static_cast<const float*>(camera->data())[i] == metadata.camera.world_to_camera[i]);
    CHECK(static_cast<const float*>(ndc->data())[i] == metadata.camera.world_to_ndc[i]);
  }
  const auto* const chromaticities = spec.find_attribute("chromaticities");
  REQUIRE(chromaticities != nullptr);
  CHECK(static_cast<const float*>(chromaticities->data())[0] == 0.64F);
  CHECK(static_cast<const float*>(chromaticities->data())[7] == 0.329F);
}

TEST_CASE("PNG metadata is text, since PNG drops numbers") {
  const SourceDateEpoch unset(nullptr);
  const TemporaryFolder folder;
  const std::string file = folder.file("a.png");
  ImageMetadata metadata = some_metadata();
  metadata.attributes = {{"raytrace:part", std::string("left")}, {"raytrace:tile", 7}, {"raytrace:weight", 0.5F}};
  write_image(file, distinct_film(8, 8), metadata, {});

  const OIIO::ImageSpec spec = read_picture(file).spec;
  CHECK(spec.get_string_attribute("raytrace:part") == "left");
  CHECK(spec.get_string_attribute("raytrace:tile") == "7");
  CHECK(spec.get_string_attribute("raytrace:weight") == "0.5");
  CHECK(spec.get_string_attribute("Software") == "raytrace 1.2.3");
  CHECK(spec.get_string_attribute("raytrace:scene") == "folder/scene.xml");
  CHECK(spec.get_string_attribute("raytrace:samples") == "16");
  CHECK(spec.get_string_attribute("raytrace:seed") == "18446744073709551615");
  CHECK(spec.get_string_attribute("raytrace:threads") == "3");
  CHECK(spec.get_string_attribute("raytrace:renderSeconds") == "12.5");
  CHECK(contains(spec.get_string_attribute("worldToNDC").c_str(), "0 -1 -2 -3 -4"));
  CHECK(has(spec, "worldToCamera"));
}

TEST_CASE("other formats get a description") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.jpg");
  write_image(file, distinct_film(8, 8), some_metadata(), {});
  CHECK(read_picture(file).spec.get_string_attribute("ImageDescription") ==
        "scene folder/scene.xml, 16 samples per pixel, seed 18446744073709551615");
}

TEST_CASE("with SOURCE_DATE_EPOCH, the same picture gives the same bytes") {
  const SourceDateEpoch epoch("86399");
  const TemporaryFolder folder;
  const std::string extension = GENERATE(".exr", ".png", ".tif", ".jpg");
  const std::string file = folder.file("a" + extension);
  const FloatPicture film = noise_film(50, 50);
  ImageMetadata metadata = some_metadata();
  ImageFileSettings settings;
  settings.threads = 1;
  write_image(file, film, metadata, settings);
  const std::string first = bytes_of(file);

  metadata.render_seconds = 99;
  metadata.threads = settings.threads = 2;
  write_image(file, film, metadata, settings);
  CHECK(bytes_of(file) == first);
  CHECK(read_picture(file).spec.get_string_attribute("DateTime") == "1970:01:01 23:59:59");
}

TEST_CASE("a SOURCE_DATE_EPOCH that is no time is refused") {
  const TemporaryFolder folder;
  const SourceDateEpoch epoch(GENERATE("", "tomorrow", "-1", "12x", "99999999999999999999", "253402300800"));
  CHECK_THROWS_AS(check_format(folder.file("a.exr"), {}), OutputError);
  CHECK_THROWS_AS(write_image(folder.file("a.exr"), distinct_film(8, 8), {}, {}), OutputError);
  CHECK(folder.names().empty());
}

TEST_CASE("metadata may be empty") {
  const TemporaryFolder folder;
  const std::string file = folder.file(GENERATE("a.exr", "a.png", "a.jpg", "a.tif"));
  write_image(file, distinct_film(8, 8), {}, {});
  CHECK(read_picture(file).spec.width == 8);
}

}  // namespace raytrace::test
