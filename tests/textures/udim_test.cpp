// Textures of UDIM tiles: each look-up is that in the tile alone which the place is in.
#include "raytrace/textures/udim.h"

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/description/load_images.h"
#include "raytrace/description/scene_description.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"
#include "textures/made_pictures.h"

namespace raytrace::test {

namespace {

/// Each pixel of the picture has this number in all its channels.
void write_even(const std::string& file, int width, int channels, const OIIO::TypeDesc& type, float number) {
  const auto output = OIIO::ImageOutput::create(file);
  REQUIRE(output);
  REQUIRE(output->open(file, OIIO::ImageSpec(width, width, channels, type)));
  const std::vector<float> numbers(
      static_cast<std::size_t>(width) * static_cast<std::size_t>(width) * static_cast<std::size_t>(channels), number);
  REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, numbers.data()));
  REQUIRE(output->close());
}

std::string scene_of_tiles(const std::string& more = "") {
  return "<raytracer>\n<viewplane><hres>4</hres><vres>3</vres></viewplane>\n<camera><eye x='0' y='0' z='9'/><lookat "
         "x='0' y='0' z='0'/><viewdistance>4</viewdistance></camera>\n<textures><images>\n<image><name>t</name><file>"
         "wood.%(UDIM)d.png</file>" +
         more +
         "</image>\n</images></textures>\n<materials><mattes><matte><name>m</name><ka>0</ka><kd texture='t'/><cd "
         "texture='t'/></matte></mattes></materials></raytracer>";
}

std::optional<SceneDescription> loaded_tiles(const TemporaryFolder& folder, std::string& messages,
                                             const std::string& more = "") {
  write_text(folder.path() / "scene.xml", scene_of_tiles(more));
  Diagnostics diagnostics("scene.xml");
  auto scene = load_scene(folder.file("scene.xml"), diagnostics, 1, {});
  for (const Diagnostic& diagnostic : diagnostics.kept())
    messages += std::to_string(diagnostic.location.line) + ": " + diagnostic.message + "\n";
  return scene;
}

TexelImage tile_image(std::mt19937& random, int width, int height, int channels, TexelFormat format) {
  return {random_picture(random, width, height, channels, format), format == TexelFormat::bytes, 1};
}

}  // namespace

TEST_CASE("tiles are found by their numbers, in order, and nothing else is") {
  const TemporaryFolder folder;
  for (const char* const name : {"a.1012.png", "a.1001.png", "a.9999.png", "a.1000.png", "a.0999.png", "a.101.png",
                                 "a.10012.png", "a.1002.jpg", "b.1003.png", "a.1x04.png", "a.+101.png"})
    write_text(folder.path() / name, "");
  for (const char* const mark : {"<UDIM>", "%(UDIM)d"}) {
    const std::string file = folder.file(std::string("a.") + mark + ".png");
    CHECK(is_udim(file));
    const std::vector<UdimTile> tiles = find_udim_tiles(file);
    REQUIRE(tiles.size() == 3);
    CHECK(tiles[0].number() == 1001);
    CHECK(tiles[1].number() == 1012);
    CHECK(std::pair(tiles[1].column, tiles[1].row) == std::pair(1, 1));
    CHECK(tiles[1].file == folder.file("a.1012.png"));
    CHECK(tiles[2].number() == 9999);
  }
  CHECK_FALSE(is_udim(folder.file("a.1001.png")));
  CHECK(find_udim_tiles(folder.file("none/a.<UDIM>.png")).empty());
}

TEST_CASE("a tile has the texels and levels of its picture; grey ones among colours are grey") {
  for (const TexelFormat format : {TexelFormat::bytes, TexelFormat::shorts, TexelFormat::halves, TexelFormat::floats}) {
    std::mt19937 random(3), again(3);
    std::vector<TexelImage::Tile> tiles;
    const bool srgb = format == TexelFormat::bytes;
    tiles.push_back({2, 0, tile_image(random, 9, 5, 4, format)});
    tiles.push_back({0, 1, tile_image(random, 3, 8, 1, format)});
    const TexelImage all = TexelImage::of_tiles(std::move(tiles));
    const TexelImage color = tile_image(again, 9, 5, 4, format), grey = tile_image(again, 3, 8, 1, format);
    REQUIRE(all.tiles().size() == 20);
    REQUIRE(all.channels() == 4);
    int missing = 0;
    for (const std::int32_t tile : all.tiles()) missing += tile < 0 ? 1 : 0;
    CHECK(missing == 18);
    const auto check_same = [&](std::size_t place, const TexelImage& one) {
      const auto first = static_cast<std::size_t>(all.tiles()[place]);
      for (std::size_t level = 0; level < static_cast<std::size_t>(all.levels_of_picture()); ++level) {
        const std::size_t own = std::min(level, one.levels().size() - 1);
        const TexelImage::Level& size = one.levels()[own];
        REQUIRE(all.levels()[first + level].width == size.width);
        REQUIRE(all.levels()[first + level].height == size.height);
        for (int y = 0; y < size.height; ++y)
          for (int x = 0; x < size.width; ++x) {
            Color4 expected = texel_of(one, own, x, y, srgb);
            if (one.channels() == 1) expected = {expected[0], expected[0], expected[0], 1};
            REQUIRE(texel_of(all, first + level, x, y, srgb) == expected);
          }
      }
    };
    check_same(2, color);
    check_same(10, grey);
  }
}

TEST_CASE("tiles of different formats are refused, by their numbers") {
  std::mt19937 random(5);
  std::vector<TexelImage::Tile> tiles;
  tiles.push_back({0, 0, tile_image(random, 2, 2, 4, TexelFormat::bytes)});
  tiles.push_back({3, 1, tile_image(random, 2, 2, 4, TexelFormat::shorts)});
  CHECK_THROWS_WITH(TexelImage::of_tiles(std::move(tiles)),
                    "the numbers of its tiles 1001 and 1014 have different formats");
}

TEST_CASE("a scene's tiles are loaded for colours and for numbers, and its hash has all of them") {
  const TemporaryFolder folder;
  write_even(folder.file("wood.1001.png"), 4, 3, OIIO::TypeDesc::UINT8, 0.25F);
  write_even(folder.file("wood.1002.png"), 8, 1, OIIO::TypeDesc::UINT8, 0.5F);
  std::string messages;
  const auto scene = loaded_tiles(folder, messages);
  INFO(messages);
  REQUIRE(scene);
  const LoadedImage& image = std::get<TextureItems<Image>>(scene->textures).at(0).image;
  REQUIRE(image.color);
  REQUIRE(image.number);
  CHECK(image.color->srgb());
  CHECK_FALSE(image.number->srgb());
  CHECK(image.color->tiles().size() == 10);
  write_even(folder.file("wood.1002.png"), 8, 1, OIIO::TypeDesc::UINT8, 0.75F);
  const auto other = loaded_tiles(folder, messages);
  REQUIRE(other);
  CHECK(std::get<TextureItems<Image>>(other->textures).at(0).image.hash != image.hash);
}

TEST_CASE("what is wrong with tiles is said in the image's line") {
  const TemporaryFolder folder;
  std::string messages;
  CHECK_FALSE(loaded_tiles(folder, messages));
  CHECK(contains(messages, "5: the texture"));
  CHECK(contains(messages, "there is no file of a tile"));
  write_text(folder.path() / "wood.1003.png", "nothing");
  messages.clear();
  CHECK_FALSE(loaded_tiles(folder, messages));
  CHECK(contains(messages, "tile 1003: "));
  messages.clear();
  CHECK_FALSE(loaded_tiles(folder, messages, "<wrap>clamp</wrap>"));
  CHECK(contains(messages, "an image of UDIM tiles has neither <wrap> nor <wrapv>"));
}

}  // namespace raytrace::test
