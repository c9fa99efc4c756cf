// Textures looked up one by one, held against their kernels.
#include "raytrace/textures/texture_value.h"

#include <array>
#include <cmath>
#include <random>

#include "raytrace/textures/kernels.h"
#include "support/catch.h"
#include "support/lanes.h"
#include "textures/made_pictures.h"

namespace raytrace::test {
namespace {

double from_0_to_1(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-32; }

/// The largest difference of any number at random places.
double worst_difference(const auto& kernel, const auto& value) {
  std::mt19937 random(11);
  double worst = 0;
  for (int round = 0; round < 200; ++round) {
    std::array<TexturePlace, lanes> places;
    const double wide = std::exp2(-8 * from_0_to_1(random)), narrow = wide * from_0_to_1(random);
    for (TexturePlace& place : places) {
      const auto anywhere = [&] { return 4 * from_0_to_1(random) - 2; };
      place.sets[0] = {{anywhere(), anywhere()}, {wide, narrow}};
      place.sets[1] = {{anywhere(), anywhere()}, {narrow, wide}};
      place.point = {anywhere(), anywhere(), anywhere()};
      place.width = wide;
      place.vertex_color = {from_0_to_1(random), from_0_to_1(random), from_0_to_1(random)};
      place.vertex_alpha = from_0_to_1(random);
    }
    const auto numbers = [&](const auto& number) {
      alignas(64) std::array<float, lanes> floats{};
      for (std::size_t lane = 0; lane < lanes; ++lane) floats[lane] = static_cast<float>(number(places[lane]));
      return FloatN::load_aligned(floats.data());
    };
    TexturePoint<FloatN> point{};
    const auto set = [&](UvPoint<FloatN>& to, std::size_t number) {
      to.uv = {numbers([&](const auto& p) { return p.sets[number].uv.x; }),
               numbers([&](const auto& p) { return p.sets[number].uv.y; })};
      to.uv_across = {numbers([&](const auto& p) { return p.sets[number].width.x; }), FloatN(0)};
      to.uv_along = {FloatN(0), numbers([&](const auto& p) { return p.sets[number].width.y; })};
    };
    set(point, 0);
    set(point.second, 1);
    point.world.p = vectors_of([&](std::size_t lane) { return places[lane].point; });
    // The checker's cubes have the width along each axis; noise that of the longer axis.
    point.world.p_across = spread({wide, 0, 0});
    point.world.p_along = spread({0, wide, 0});
    point.vertex_color = {numbers([](const auto& p) { return p.vertex_color.red; }),
                          numbers([](const auto& p) { return p.vertex_color.green; }),
                          numbers([](const auto& p) { return p.vertex_color.blue; })};
    point.vertex_alpha = numbers([](const auto& p) { return p.vertex_alpha; });
    const Rgba<FloatN> wanted = kernel.at(point);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const TextureValue found = value(places[lane]);
      const FloatN* const all[] = {&wanted.color.red, &wanted.color.green, &wanted.color.blue, &wanted.alpha};
      for (std::size_t i = 0; i < 4; ++i)
        worst = std::max(worst, std::abs(found[i] - static_cast<double>(all[i]->get(lane))));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("noise and checkers have one by one the values of their kernels") {
  const Noise::Parameters noise{{0.1, 0.2, 0.3}, {1, 0.5, 0}, 0.3, 5};
  CHECK(worst_difference(Kernel<Noise>(noise), [&](const auto& place) { return texture_value(noise, place); }) < 1e-5);
  for (const UvSet set : {UvSet::first, UvSet::second}) {
    Checker::Parameters checker{{1, 0.9, 0.8}, {0, 0.1, 0.2}, {3, -2}};
    checker.uvset = set;
    CHECK(worst_difference(Kernel<Checker>(checker), [&](const auto& place) { return texture_value(checker, place); }) <
          2e-3);
  }
  const VertexColor::Parameters vertices{2, -0.5};
  CHECK(worst_difference(Kernel<VertexColor>(vertices),
                         [&](const auto& place) { return texture_value(vertices, place); }) < 1e-6);
}

TEST_CASE("images have one by one the values of their kernel") {
  std::mt19937 random(4);
  for (const TexelFormat format : {TexelFormat::bytes, TexelFormat::shorts, TexelFormat::halves, TexelFormat::floats})
    for (const int channels : {1, 4})
      for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black}) {
        const bool srgb = format == TexelFormat::bytes && wrap == Wrap::mirror;
        const auto texels =
            std::make_shared<const TexelImage>(random_picture(random, 13, 6, channels, format), srgb, 1);
        Image::Parameters image;
        image.wrap = wrap;
        image.uvscale = {1.5, -0.7};
        image.uvrotation = 30;
        image.uvoffset = {0.3, 0.1};
        image.valuescale = 0.8;
        image.valueoffset = 0.1;
        image.uvset = channels == 1 ? UvSet::first : UvSet::second;
        image.vertexalpha = wrap == Wrap::clamp;
        INFO(static_cast<int>(format) << ' ' << channels << ' ' << static_cast<int>(wrap));
        CHECK(worst_difference(Kernel<Image>(image, texels), [&](const auto& place) {
                return texture_value(image, texels.get(), place);
              }) < (srgb ? 2e-3 : 1e-4));
      }
}

TEST_CASE("tiles of an image have one by one the values of its kernel") {
  std::mt19937 random(6);
  std::vector<TexelImage::Tile> tiles;
  for (const int column : {0, 1})
    tiles.push_back({column, 1, TexelImage(random_picture(random, 8, 8, 4, TexelFormat::bytes), false, 1)});
  const auto texels = std::make_shared<const TexelImage>(TexelImage::of_tiles(std::move(tiles)));
  const Image::Parameters image;
  CHECK(worst_difference(Kernel<Image>(image, texels),
                         [&](const auto& place) { return texture_value(image, texels.get(), place); }) < 1e-4);
}

}  // namespace raytrace::test
