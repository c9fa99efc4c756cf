// Files of textures: what is read, and what is said of those that cannot be.
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "raytrace/description/load_images.h"
#include "raytrace/description/scene_description.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"
#include "textures/made_pictures.h"

namespace raytrace::test {

namespace {

/// numbers: from the upper left pixel on.
template <class Number>
void write_picture(const std::string& file, int width, int height, int channels, const OIIO::TypeDesc& type,
                   const std::vector<Number>& numbers) {
  const auto output = OIIO::ImageOutput::create(file);
  REQUIRE(output);
  OIIO::ImageSpec spec(width, height, channels, type);
  spec["oiio:UnassociatedAlpha"] = 1;
  REQUIRE(output->open(file, spec));
  REQUIRE(output->write_image(OIIO::BaseTypeFromC<Number>::value, numbers.data()));
  REQUIRE(output->close());
}

/// A scene whose image is the given file, for a colour and a number of a matte.
std::string scene_of(const std::string& file, const std::string& more = "") {
  return "<raytracer>\n<viewplane><hres>4</hres><vres>3</vres></viewplane>\n<camera><eye x='0' y='0' z='9'/><lookat "
         "x='0' y='0' z='0'/><viewdistance>4</viewdistance></camera>\n<textures><images>\n<image><name>t</name><file>" +
         file + "</file>" + more +
         "</image>\n</images></textures>\n<materials><mattes><matte><name>m</name><ka>0</ka><kd texture='t'/><cd "
         "texture='t'/></matte></mattes></materials></raytracer>";
}

std::optional<SceneDescription> loaded(const TemporaryFolder& folder, const std::string& text, std::string& messages,
                                       const SceneSettings& settings = {}) {
  write_text(folder.path() / "scene.xml", text);
  Diagnostics diagnostics("scene.xml");
  auto scene = load_scene(folder.file("scene.xml"), diagnostics, 1, settings);
  messages.clear();
  for (const Diagnostic& diagnostic : diagnostics.kept())
    messages += std::to_string(diagnostic.location.line) + ": " + diagnostic.message + "\n";
  return scene;
}

SceneDescription loaded(const TemporaryFolder& folder, const std::string& text) {
  std::string messages;
  auto scene = loaded(folder, text, messages);
  INFO(messages);
  REQUIRE(scene.has_value());
  return std::move(*scene);
}

const LoadedImage& image_of(const SceneDescription& scene) {
  return std::get<TextureItems<Image>>(scene.textures).at(0).image;
}

}  // namespace

TEST_CASE("8 bit pictures are sRGB as colours and linear as numbers, unless the scene says otherwise") {
  const TemporaryFolder folder;
  write_picture<std::uint8_t>(folder.file("a.png"), 2, 1, 3, OIIO::TypeUInt8, {128, 64, 0, 255, 32, 16});
  const SceneDescription scene = loaded(folder, scene_of("a.png"));
  const LoadedImage& image = image_of(scene);
  CHECK(image.color->format() == TexelFormat::bytes);
  CHECK(image.color->channels() == 4);
  CHECK(image.color->srgb());
  CHECK_FALSE(image.number->srgb());
  CHECK(texel_of(*image.color, 0, 1, 0, false) == Color4{1, 32 / 255.0, 16 / 255.0, 1});
  const SceneDescription linear = loaded(folder, scene_of("a.png", "<colorspace>linear</colorspace>"));
  CHECK_FALSE(image_of(linear).color->srgb());
  CHECK(image_of(linear).color == image_of(linear).number);
}

TEST_CASE("pictures of all depths and channels are kept as they are") {
  const TemporaryFolder folder;
  write_picture<std::uint16_t>(folder.file("a.png"), 1, 2, 1, OIIO::TypeUInt16, {1000, 2000});
  const SceneDescription grey = loaded(folder, scene_of("a.png"));
  CHECK(image_of(grey).color->format() == TexelFormat::shorts);
  CHECK(image_of(grey).color->channels() == 1);
  CHECK(texel_of(*image_of(grey).color, 0, 0, 0, false)[0] == 2000 / 65535.0);
  write_picture<std::uint8_t>(folder.file("b.png"), 1, 1, 2, OIIO::TypeUInt8, {50, 100});
  CHECK(texel_of(*image_of(loaded(folder, scene_of("b.png"))).color, 0, 0, 0, false) ==
        Color4{50 / 255.0, 50 / 255.0, 50 / 255.0, 100 / 255.0});
  write_picture<float>(folder.file("c.exr"), 1, 1, 3, OIIO::TypeHalf, {0.5F, -2, 8});
  const SceneDescription half = loaded(folder, scene_of("c.exr"));
  CHECK(image_of(half).color->format() == TexelFormat::halves);
  CHECK(image_of(half).color->largest() == 8);
  CHECK(texel_of(*image_of(half).color, 0, 0, 0, false) == Color4{0.5, -2, 8, 1});
  write_picture<float>(folder.file("d.exr"), 1, 1, 4, OIIO::TypeFloat, {0.1F, 0.2F, 0.3F, 1});
  CHECK(image_of(loaded(folder, scene_of("d.exr"))).color->format() == TexelFormat::floats);
}

TEST_CASE("a picture's alpha is known from that of 1 which others get") {
  const TemporaryFolder folder;
  write_picture<std::uint8_t>(folder.file("a.png"), 1, 1, 3, OIIO::TypeUInt8, {1, 2, 3});
  CHECK_FALSE(image_of(loaded(folder, scene_of("a.png"))).number->has_alpha());
  write_picture<std::uint8_t>(folder.file("b.png"), 1, 1, 4, OIIO::TypeUInt8, {1, 2, 3, 255});
  CHECK(image_of(loaded(folder, scene_of("b.png"))).number->has_alpha());
  write_picture<std::uint8_t>(folder.file("c.png"), 1, 1, 2, OIIO::TypeUInt8, {1, 2});
  CHECK(image_of(loaded(folder, scene_of("c.png"))).number->has_alpha());
  write_picture<std::uint16_t>(folder.file("d.png"), 1, 1, 3, OIIO::TypeUInt16, {1, 2, 3});
  CHECK_FALSE(image_of(loaded(folder, scene_of("d.png", "<colorspace>srgb</colorspace>"))).color->has_alpha());
}

TEST_CASE("a picture that cannot be read is an error in the line of its image, or magenta") {
  const TemporaryFolder folder;
  std::string messages;
  CHECK_FALSE(loaded(folder, scene_of("none.png"), messages).has_value());
  CHECK(contains(messages, "none.png' cannot be used: there is no such file"));
  CHECK_FALSE(loaded(folder, scene_of("."), messages).has_value());
  CHECK(contains(messages, "/.' cannot be used: it is no file"));
  write_text(folder.path() / "text.png", "no picture");
  CHECK_FALSE(loaded(folder, scene_of("text.png"), messages).has_value());
  CHECK(contains(messages, "text.png' cannot be used: "));
  write_picture<std::uint8_t>(folder.file("a.png"), 64, 64, 1, OIIO::TypeUInt8, std::vector<std::uint8_t>(64 * 64, 77));
  write_text(folder.path() / "half.png", bytes_of(folder.path() / "a.png").substr(0, 100));
  CHECK_FALSE(loaded(folder, scene_of("half.png"), messages).has_value());
  CHECK(contains(messages, "half.png' cannot be used: "));

  SceneSettings settings;
  settings.textures.missing = MissingTexture::warn;
  const auto scene = loaded(folder, scene_of("none.png"), messages, settings);
  REQUIRE(scene.has_value());
  CHECK(contains(messages, "it is magenta"));
  CHECK(texel_of(*image_of(*scene).color, 0, 0, 0, false) == Color4{1, 0, 1, 1});
}

TEST_CASE("texels beyond the memory for them lie in files, and are the same") {
  const TemporaryFolder folder;
  write_picture<std::uint8_t>(folder.file("a.png"), 64, 64, 1, OIIO::TypeUInt8, std::vector<std::uint8_t>(64 * 64, 77));
  const auto mapped_files = [] {
    std::ifstream maps("/proc/self/maps");
    int count = 0;
    for (std::string line; std::getline(maps, line);) count += contains(line, "(deleted)") ? 1 : 0;
    return count;
  };
  const int before = mapped_files();
  SceneSettings settings;
  std::string messages;
  settings.textures.memory = std::uint64_t{1} << 20U;
  const auto in_memory = loaded(folder, scene_of("a.png"), messages, settings);
  REQUIRE(in_memory.has_value());
  CHECK(mapped_files() == before);
  settings.textures.memory = 1000;
  {
    const auto in_file = loaded(folder, scene_of("a.png"), messages, settings);
    REQUIRE(in_file.has_value());
    CHECK(messages.empty());
    CHECK(mapped_files() > before);
    const TexelImage &a = *image_of(*in_memory).color, &b = *image_of(*in_file).color;
    REQUIRE(a.bytes() == b.bytes());
    CHECK(std::memcmp(a.texels(), b.texels(), a.bytes()) == 0);
    CHECK(scene_hash(*in_memory) == scene_hash(*in_file));
  }
  CHECK(mapped_files() == before);
}

TEST_CASE("where no file can be written, texels stay in memory, with a warning") {
  const TemporaryFolder folder;
  write_picture<std::uint8_t>(folder.file("a.png"), 1, 1, 1, OIIO::TypeUInt8, {77});
  const char* const usual = std::getenv("TMPDIR");
  const std::string before = usual != nullptr ? usual : "";
  setenv("TMPDIR", folder.file("none").c_str(), 1);
  SceneSettings settings;
  settings.textures.memory = 0;
  std::string messages;
  const auto scene = loaded(folder, scene_of("a.png"), messages, settings);
  if (usual != nullptr)
    setenv("TMPDIR", before.c_str(), 1);
  else
    unsetenv("TMPDIR");
  REQUIRE(scene.has_value());
  CHECK(contains(messages, "none: No such file or directory"));
  CHECK(texel_of(*image_of(*scene).color, 0, 0, 0, false)[0] == 77 / 255.0);
}

TEST_CASE("a scene's hash has its textures' bytes") {
  const TemporaryFolder folder;
  const auto hash_with = [&](std::uint8_t grey) {
    write_picture<std::uint8_t>(folder.file("a.png"), 1, 1, 1, OIIO::TypeUInt8, {grey});
    return scene_hash(loaded(folder, scene_of("a.png")));
  };
  const std::string first = hash_with(1);
  CHECK(hash_with(2) != first);
  CHECK(hash_with(1) == first);
}

TEST_CASE("an environment's file is loaded, hashed and missed as a texture's is") {
  const TemporaryFolder folder;
  const std::string scene = scene_of("a.png"), root = "<raytracer>\n";
  const auto in = [&](const std::string& file) {
    std::string text = scene;
    return text.insert(root.size(), "<lights><environmentlights>\n<environmentlight><file>" + file +
                                        "</file></environmentlight></environmentlights></lights>");
  };
  write_picture<std::uint8_t>(folder.file("a.png"), 1, 1, 3, OIIO::TypeUInt8, {1, 2, 3});
  const auto hash_with = [&](std::uint8_t grey) {
    write_picture<std::uint8_t>(folder.file("b.png"), 1, 1, 1, OIIO::TypeUInt8, {grey});
    return scene_hash(loaded(folder, in("b.png")));
  };
  const std::string first = hash_with(9);
  CHECK(hash_with(10) != first);
  CHECK(hash_with(9) == first);
  const auto light = [](const SceneDescription& from) {
    return std::get<LightItems<EnvironmentLight>>(from.lights).at(0);
  };
  CHECK(texel_of(*light(loaded(folder, in("b.png"))).image.color, 0, 0, 0, false)[0] == 9 / 255.0);

  std::string messages;
  CHECK_FALSE(loaded(folder, in("none.exr"), messages).has_value());
  CHECK(contains(messages, "3: the environment '"));
  CHECK(contains(messages, "none.exr' cannot be used: there is no such file"));
  SceneSettings settings;
  settings.textures.missing = MissingTexture::warn;
  const auto magenta = loaded(folder, in("none.exr"), messages, settings);
  REQUIRE(magenta.has_value());
  CHECK(texel_of(*light(*magenta).image.color, 0, 0, 0, false) == Color4{1, 0, 1, 1});
}

TEST_CASE("images of one file share its texels") {
  const TemporaryFolder folder;
  write_picture<std::uint8_t>(folder.file("a.png"), 1, 1, 3, OIIO::TypeUInt8, {1, 2, 3});
  std::string text = scene_of("a.png");
  text.insert(text.find("<image>"), "<image><name>other</name><file>a.png</file></image>");
  text.replace(text.find("<kd texture='t'/>"), 17, "<kd>1</kd>");
  text.insert(text.find("</mattes>"), "<matte><name>n</name><ka>0</ka><kd>1</kd><cd texture='other'/></matte>");
  const SceneDescription scene = loaded(folder, text);
  const auto& images = std::get<TextureItems<Image>>(scene.textures);
  CHECK(images.at(0).image.color != nullptr);
  CHECK(images.at(0).image.color == images.at(1).image.color);
  CHECK(images.at(0).image.number == nullptr);
}

}  // namespace raytrace::test
