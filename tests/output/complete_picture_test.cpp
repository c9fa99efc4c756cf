// Pictures that need not be rendered again.
#include "raytrace/output/complete_picture.h"

#include "pictures.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

TEST_CASE("a picture is complete only with its last byte") {
  const TemporaryFolder folder;
  for (const char* const name : {"a.exr", "a.PNG"}) {
    const std::string file = folder.file(name);
    write_image(file, distinct_film(9, 7), {}, {});
    const std::string whole = bytes_of(file);
    CHECK(is_complete_picture(file));
    for (std::size_t length = 0; length < whole.size(); length += length < whole.size() - 32 ? 16 : 1) {
      write_text(file, whole.substr(0, length));
      CHECK_FALSE(is_complete_picture(file));
    }
  }
  CHECK_FALSE(is_complete_picture(folder.file("missing.png")));
}

TEST_CASE("a picture that is marked as unfinished, or of other attributes, is not the one") {
  const TemporaryFolder folder;
  const std::string file = folder.file(GENERATE("a.exr", "a.png"));
  ImageMetadata metadata;
  metadata.attributes = {{"raytrace:sceneHash", "1f"}, {"raytrace:centered", 1}};
  WantedPicture wanted;
  wanted.extent = {9, 7, {0, 0, 9, 7}};
  wanted.channels = color_channels(false);
  wanted.attributes = {{"raytrace:sceneHash", "1f"}, {"raytrace:centered", "1"}, {"raytrace:other", ""}};
  write_image(file, distinct_film(9, 7), metadata, {});
  CHECK(is_complete_picture(file, wanted));
  for (const char* const name : {"raytrace:sceneHash", "raytrace:centered", "raytrace:other"}) {
    WantedPicture another = wanted;
    another.attributes[name] = "2";
    CHECK_FALSE(is_complete_picture(file, another));
  }
  WantedPicture larger = wanted;
  larger.extent = {9, 8, {0, 0, 9, 8}};
  CHECK_FALSE(is_complete_picture(file, larger));
  metadata.attributes.push_back({"raytrace:partial", 1});
  write_image(file, distinct_film(9, 7), metadata, {});
  CHECK_FALSE(is_complete_picture(file));
}

TEST_CASE("the texts of a PNG are read, be they Latin-1 or UTF-8") {
  const TemporaryFolder folder;
  const auto chunk = [](const std::string& kind, const std::string& content) {
    const auto size = static_cast<char>(content.size());
    return std::string("\0\0\0", 3) + size + kind + content + "CRC.";
  };
  const std::string start =
      std::string("\x89PNG\r\n\x1a\n") + chunk("IHDR", std::string("\0\0\0\3\0\0\0\2\x10\2\0\0\0", 13)) +
      chunk("tEXt", std::string("a\0one", 5)) + chunk("iTXt", std::string("b\0\0\0en\0key\0t\xc3\xbc", 14)) +
      chunk("iTXt", std::string("c\0\1\0\0\0xxx", 9)) + chunk("IDAT", "....");
  write_text(folder.file("a.png"), start + chunk("IEND", ""));
  const auto png = read_png_file(folder.file("a.png"));
  REQUIRE(png);
  CHECK((png->width == 3 && png->height == 2 && png->bits == 16));
  CHECK(png->texts == std::map<std::string, std::string>{{"a", "one"}, {"b", "t\xc3\xbc"}});
  write_text(folder.file("a.png"), start + std::string("\xff\xff\xff\xfftEXt", 8));
  CHECK_FALSE(read_png_file(folder.file("a.png")));
}

}  // namespace raytrace::test
