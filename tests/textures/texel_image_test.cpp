// The ever smaller pictures of an image.
#include <algorithm>
#include <set>

#include "support/catch.h"
#include "textures/made_pictures.h"

namespace raytrace::test {

namespace {

Color4 mean_of(const TexelImage& image, std::size_t level, bool srgb) {
  const TexelImage::Level& size = image.levels()[level];
  Color4 mean{};
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Color4 color = texel_of(image, level, x, y, srgb);
      for (std::size_t c = 0; c < 4; ++c) mean[c] += color[c] / (size.width * size.height);
    }
  return mean;
}

}  // namespace

TEST_CASE("the smallest picture is the mean of the largest, in linear light, whatever the size and the format") {
  std::mt19937 random(3);
  for (const TexelFormat format : {TexelFormat::bytes, TexelFormat::shorts, TexelFormat::halves, TexelFormat::floats})
    for (const int channels : {1, 4})
      for (const auto& [width, height] : {std::pair{64, 64}, {37, 51}, {1, 9}, {128, 2}, {1, 1}}) {
        const bool srgb = format == TexelFormat::bytes;
        const TexelImage image(random_picture(random, width, height, channels, format), srgb, 2);
        const TexelImage::Level& last = image.levels().back();
        REQUIRE(last.width == 1);
        REQUIRE(last.height == 1);
        const Color4 wanted = mean_of(image, 0, srgb), mean = texel_of(image, image.levels().size() - 1, 0, 0, srgb);
        // Texels are rounded at each level.
        const double tolerance = format == TexelFormat::bytes    ? 0.012
                                 : format == TexelFormat::shorts ? 4e-5
                                 : format == TexelFormat::halves ? 2e-3
                                                                 : 2e-6;
        INFO(width << " x " << height << ", " << channels << " channels, format " << static_cast<int>(format));
        for (std::size_t c = 0; c < 4; ++c) CHECK(std::abs(mean[c] - wanted[c]) < tolerance);
      }
}

TEST_CASE("each smaller picture is half as wide and high, and each of its texels the mean of four") {
  std::mt19937 random(5);
  const TexelImage image(random_picture(random, 32, 16, 4, TexelFormat::floats), false, 1);
  REQUIRE(image.levels().size() == 6);
  for (std::size_t level = 1; level < 5; ++level) {
    const TexelImage::Level& size = image.levels()[level];
    REQUIRE(size.width == 32 >> level);
    REQUIRE(size.height == 16 >> level);
    double worst = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        for (std::size_t c = 0; c < 4; ++c) {
          double sum = 0;
          for (const int dy : {0, 1})
            for (const int dx : {0, 1}) sum += texel_of(image, level - 1, 2 * x + dx, 2 * y + dy, false)[c];
          worst = std::max(worst, std::abs(sum / 4 - texel_of(image, level, x, y, false)[c]));
        }
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("every texel has a place of its own, and rows count from the bottom") {
  std::mt19937 random(7);
  const Picture picture = random_picture(random, 37, 22, 1, TexelFormat::floats);
  const TexelImage image(picture, false, 1);
  std::set<std::int64_t> places;
  std::size_t texels = 0;
  for (const TexelImage::Level& level : image.levels())
    for (int y = 0; y < level.height; ++y)
      for (int x = 0; x < level.width; ++x, ++texels) places.insert(TexelImage::index(level, x, y));
  CHECK(places.size() == texels);
  float corner = 0;
  std::memcpy(&corner, picture.pixels.data() + 21 * 37 * sizeof corner, sizeof corner);
  CHECK(texel_of(image, 0, 0, 0, false)[0] == static_cast<double>(corner));
}

TEST_CASE("numbers that are none are 0, and the largest is known") {
  Picture picture{3, 1, 1, TexelFormat::floats, LargeArray<std::byte>::zeros(12)};
  const std::array<float, 3> numbers{std::nanf(""), -7.5F, HUGE_VALF};
  std::memcpy(picture.pixels.data(), numbers.data(), sizeof numbers);
  const TexelImage image(picture, false, 1);
  CHECK(texel_of(image, 0, 0, 0, false)[0] == 0);
  CHECK(texel_of(image, 0, 1, 0, false)[0] == -7.5);
  CHECK(texel_of(image, 0, 2, 0, false)[0] == 0);
  CHECK(image.largest() == 7.5F);
}

TEST_CASE("sRGB that is not kept in bytes is decoded, but for alpha") {
  Picture picture{1, 1, 4, TexelFormat::shorts, LargeArray<std::byte>::zeros(8)};
  const std::array<std::uint16_t, 4> codes{65535, 32768, 1000, 32768};
  std::memcpy(picture.pixels.data(), codes.data(), sizeof codes);
  const Color4 color = texel_of(TexelImage(picture, true, 1), 0, 0, 0, false);
  for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(color[c] - decoded_srgb(codes[c] / 65535.0)) < 1e-6);
  CHECK(std::abs(color[3] - 32768 / 65535.0) < 1e-6);
}

}  // namespace raytrace::test
