// Look-ups in images, against the formula in double precision.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "raytrace/textures/image_kernel.h"
#include "support/catch.h"
#include "support/lanes.h"
#include "textures/made_pictures.h"

namespace raytrace::test {

namespace {

struct Place {
  double u, v;
  double width = 0, height = 0;  ///< of what is covered, in u and v
};

TexturePoint<FloatN> point_of(const std::array<Place, lanes>& places) {
  const auto batch = [&](double Place::* member) {
    return batch_of<FloatN>([&](std::size_t lane) { return places[lane].*member; });
  };
  TexturePoint<FloatN> point{};
  point.uv = {batch(&Place::u), batch(&Place::v)};
  point.uv_across = {batch(&Place::width), FloatN(0)};
  point.uv_along = {FloatN(0), batch(&Place::height)};
  return point;
}

Color4 lane_of(const Rgba<FloatN>& color, std::size_t lane) {
  return {static_cast<double>(color.color.red.get(lane)), static_cast<double>(color.color.green.get(lane)),
          static_cast<double>(color.color.blue.get(lane)), static_cast<double>(color.alpha.get(lane))};
}

/// The texel that a rule has for the place i of a row of n; -1: none.
int wrapped_index(int i, int n, Wrap wrap) {
  if (wrap == Wrap::repeat) return (i % n + n) % n;
  if (wrap == Wrap::clamp) return std::clamp(i, 0, n - 1);
  if (wrap == Wrap::black) return i >= 0 && i < n ? i : -1;
  const int j = (i % (2 * n) + 2 * n) % (2 * n);
  return j < n ? j : 2 * n - 1 - j;
}

struct Wraps {
  Wrap u, v;
  Wraps(Wrap both) : u(both), v(both) {}
  Wraps(Wrap u_wrap, Wrap v_wrap) : u(u_wrap), v(v_wrap) {}
};

Color4 reference_texel(const TexelImage& image, std::size_t level, int x, int y, const Wraps& wraps, bool srgb) {
  const TexelImage::Level& size = image.levels()[level];
  const int column = wrapped_index(x, size.width, wraps.u), row = wrapped_index(y, size.height, wraps.v);
  if (column < 0 || row < 0) return {0, 0, 0, 0};
  return texel_of(image, level, column, row, srgb);
}

Color4 reference_bilinear(const TexelImage& image, std::size_t level, double u, double v, const Wraps& wraps,
                          bool srgb) {
  const TexelImage::Level& size = image.levels()[level];
  const double x = u * size.width - 0.5, y = v * size.height - 0.5;
  const int left = static_cast<int>(std::floor(x)), low = static_cast<int>(std::floor(y));
  Color4 sum{};
  for (const int dy : {0, 1})
    for (const int dx : {0, 1}) {
      const double share = (dx == 0 ? 1 - (x - left) : x - left) * (dy == 0 ? 1 - (y - low) : y - low);
      const Color4 texel = reference_texel(image, level, left + dx, low + dy, wraps, srgb);
      for (std::size_t c = 0; c < 4; ++c) sum[c] += share * texel[c];
    }
  return sum;
}

double difference(const Color4& a, const Color4& b) {
  double largest = 0;
  for (std::size_t c = 0; c < 4; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

class RandomPlaces {
 public:
  explicit RandomPlaces(unsigned seed) : bits_(seed) {}
  double from(double least, double most) { return least + (most - least) * static_cast<double>(bits_()) * 0x1p-32; }
  std::array<Place, lanes> places(double reach, double covered) {
    std::array<Place, lanes> result{};
    for (Place& place : result) {
      // Of numbers that floats have.
      const auto number = [&](double least, double most) { return std::round(from(least, most) * 65536) / 65536; };
      place = {number(-reach, reach), number(-reach, reach), number(0, covered), number(0, covered)};
    }
    return result;
  }

 private:
  std::mt19937 bits_;
};

Kernel<Image> kernel_of(const TexelImage& image, const Image::Parameters& parameters) {
  return {parameters, std::shared_ptr<const TexelImage>(&image, [](const TexelImage*) {})};
}

constexpr std::array every_wrap{Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black};

Image::Parameters with_wrap(Wrap wrap) {
  Image::Parameters parameters;
  parameters.wrap = wrap;
  return parameters;
}

}  // namespace

TEST_CASE("from near, an image is bilinear between its texels: all formats, wraps and sizes") {
  std::mt19937 random(11);
  RandomPlaces chance(13);
  for (const TexelFormat format : {TexelFormat::bytes, TexelFormat::shorts, TexelFormat::halves, TexelFormat::floats})
    for (const int channels : {1, 4})
      for (const auto& [width, height] : {std::pair{16, 8}, {7, 13}, {1, 1}, {2, 1}}) {
        const bool srgb = format == TexelFormat::bytes;
        const TexelImage image(random_picture(random, width, height, channels, format), srgb, 1);
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black}) {
          const Kernel<Image> kernel = kernel_of(image, with_wrap(wrap));
          double worst = 0;
          for (int i = 0; i < 20; ++i) {
            const auto places = chance.places(3, 0);
            const Rgba<FloatN> found = kernel.at(point_of(places));
            for (std::size_t lane = 0; lane < lanes; ++lane)
              worst = std::max(worst, difference(lane_of(found, lane), reference_bilinear(image, 0, places[lane].u,
                                                                                          places[lane].v, wrap, srgb)));
          }
          INFO(width << " x " << height << ", " << channels << " channels, format " << static_cast<int>(format)
                     << ", wrap " << static_cast<int>(wrap));
          CHECK(worst < (srgb ? 2e-4 : 3e-5));  // the kernel's polynomial for sRGB
        }
      }
}

TEST_CASE("an image has a wrap of its own above and below, between texels and at the nearest one") {
  std::mt19937 random(29);
  RandomPlaces chance(31);
  const TexelImage image(random_picture(random, 8, 5, 4, TexelFormat::bytes), false, 1);
  for (const Wrap u : every_wrap)
    for (const Wrap v : every_wrap)
      for (const TextureFilter filter : {TextureFilter::smart, TextureFilter::nearest}) {
        Image::Parameters parameters = with_wrap(u);
        parameters.wrapv = Image::own_wrap_v(v);
        parameters.filter = filter;
        const Kernel<Image> kernel = kernel_of(image, parameters);
        double worst = 0;
        for (int i = 0; i < 20; ++i) {
          auto places = chance.places(3, 0);
          for (Place& place : places) place.u += 0x1p-17, place.v += 0x1p-17;  // on no edge, where mirrors differ
          const Rgba<FloatN> found = kernel.at(point_of(places));
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Place& place = places[lane];
            const auto cell = [](double x) { return static_cast<int>(std::floor(x)); };
            const Color4 wanted = filter == TextureFilter::nearest
                                      ? reference_texel(image, 0, cell(place.u * 8), cell(place.v * 5), {u, v}, false)
                                      : reference_bilinear(image, 0, place.u, place.v, {u, v}, false);
            worst = std::max(worst, difference(lane_of(found, lane), wanted));
          }
        }
        INFO("wraps " << static_cast<int>(u) << " and " << static_cast<int>(v));
        CHECK(worst < 3e-5);
      }
  // Left out, it is the other one.
  CHECK(Image::wrap_v(with_wrap(Wrap::black)) == Wrap::black);
}

TEST_CASE("the nearest texel is what the place lies in") {
  std::mt19937 random(17);
  RandomPlaces chance(19);
  const TexelImage image(random_picture(random, 8, 4, 4, TexelFormat::bytes), false, 1);
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black}) {
    Image::Parameters parameters = with_wrap(wrap);
    parameters.filter = TextureFilter::nearest;
    const Kernel<Image> kernel = kernel_of(image, parameters);
    double worst = 0;
    for (int i = 0; i < 50; ++i) {
      auto places = chance.places(3, 1);
      for (Place& place : places) place.u += 0x1p-17, place.v += 0x1p-17;  // on no edge, where mirrors differ
      const Rgba<FloatN> found = kernel.at(point_of(places));
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto cell = [](double x) { return static_cast<int>(std::floor(x)); };
        const Color4 wanted =
            reference_texel(image, 0, cell(places[lane].u * 8), cell(places[lane].v * 4), wrap, false);
        worst = std::max(worst, difference(lane_of(found, lane), wanted));
      }
    }
    INFO("wrap " << static_cast<int>(wrap));
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("the level follows what is covered, and between two of them it is their mix") {
  std::mt19937 random(23);
  RandomPlaces chance(29);
  const TexelImage image(random_picture(random, 64, 32, 4, TexelFormat::floats), false, 1);
  const Kernel<Image> kernel = kernel_of(image, {});
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const auto places = chance.places(2, i % 2 == 0 ? 0.5 : 4);
    const Rgba<FloatN> found = kernel.at(point_of(places));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Place& place = places[lane];
      const double a = place.width * 64, b = place.height * 32;
      const double covered = std::max({std::min(a, b), std::max(a, b) / 2, 1.0});
      const double level = std::min(std::log2(covered), 6.0);
      const auto lower = static_cast<std::size_t>(level);
      const Color4 sharper = reference_bilinear(image, lower, place.u, place.v, Wrap::repeat, false);
      const Color4 other =
          reference_bilinear(image, std::min<std::size_t>(lower + 1, 6), place.u, place.v, Wrap::repeat, false);
      Color4 wanted{};
      const double part = level - static_cast<double>(lower);
      for (std::size_t c = 0; c < 4; ++c) wanted[c] = sharper[c] + (other[c] - sharper[c]) * part;
      worst = std::max(worst, difference(lane_of(found, lane), wanted));
    }
  }
  CHECK(worst < 3e-5);
}

TEST_CASE("places are scaled, then turned, then moved") {
  std::mt19937 random(31);
  RandomPlaces chance(37);
  const TexelImage image(random_picture(random, 16, 16, 4, TexelFormat::floats), false, 1);
  Image::Parameters parameters;
  parameters.uvscale = {2, -0.5};
  parameters.uvrotation = 30;
  parameters.uvoffset = {0.25, 0.125};
  const Kernel<Image> kernel = kernel_of(image, parameters);
  double worst = 0;
  for (int i = 0; i < 50; ++i) {
    const auto places = chance.places(1, 0);
    const Rgba<FloatN> found = kernel.at(point_of(places));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double x = 2 * places[lane].u, y = -0.5 * places[lane].v;
      const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
      worst = std::max(
          worst, difference(lane_of(found, lane), reference_bilinear(image, 0, c * x - s * y + 0.25,
                                                                     s * x + c * y + 0.125, Wrap::repeat, false)));
    }
  }
  CHECK(worst < 2e-4);
}

TEST_CASE("values are scaled, then moved, alpha with them") {
  std::mt19937 random(41);
  RandomPlaces chance(43);
  const TexelImage image(random_picture(random, 16, 16, 4, TexelFormat::floats), false, 1);
  Image::Parameters parameters;
  parameters.valuescale = -3;
  parameters.valueoffset = 0.5;
  const Kernel<Image> kernel = kernel_of(image, parameters), as_it_is = kernel_of(image, Image::Parameters{});
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const auto places = chance.places(1, 0);
    const Rgba<FloatN> found = kernel.at(point_of(places)), before = as_it_is.at(point_of(places));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Color4 a = lane_of(found, lane), b = lane_of(before, lane);
      for (std::size_t c = 0; c < a.size(); ++c) worst = std::max(worst, std::abs(a[c] - (0.5 - 3 * b[c])));
    }
  }
  CHECK(worst < 1e-6);
  CHECK(double{kernel.largest()} == Approx(3 * double{as_it_is.largest()} + 0.5));
}

TEST_CASE("a place among tiles is looked up in its own, to the bit; nothing is where there is none") {
  std::mt19937 random(53);
  RandomPlaces chance(59);
  struct Alone {
    int column, row, width, height;
  };
  constexpr std::array<Alone, 3> sizes{{{0, 0, 16, 8}, {1, 0, 7, 13}, {0, 1, 1, 4}}};
  for (const TextureFilter filter : {TextureFilter::smart, TextureFilter::nearest}) {
    std::vector<TexelImage> alone;
    std::vector<TexelImage::Tile> tiles;
    for (const Alone& one : sizes) {
      const Picture picture = random_picture(random, one.width, one.height, 4, TexelFormat::floats);
      alone.emplace_back(picture, false, 1);
      tiles.push_back({one.column, one.row, TexelImage(picture, false, 1)});
    }
    const TexelImage all = TexelImage::of_tiles(std::move(tiles));
    Image::Parameters parameters;
    parameters.filter = filter;
    const Kernel<Image> kernel = kernel_of(all, parameters);
    parameters.wrap = Wrap::clamp;
    int different = 0, outside = 0;
    for (int i = 0; i < 100; ++i) {
      const auto places = chance.places(2.5, 0.3);
      const Rgba<FloatN> found = kernel.at(point_of(places));
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        Place place = places[lane];
        const double column = std::floor(place.u), row = std::floor(place.v);
        Color4 expected{};
        bool is_there = false;
        for (std::size_t tile = 0; tile < sizes.size(); ++tile) {
          if (column != sizes[tile].column || row != sizes[tile].row) continue;
          place.u -= column;
          place.v -= row;
          std::array<Place, lanes> same{};
          same.fill(place);
          expected = lane_of(kernel_of(alone[tile], parameters).at(point_of(same)), 0);
          is_there = true;
        }
        outside += is_there ? 0 : 1;
        different += lane_of(found, lane) != expected ? 1 : 0;
      }
    }
    CHECK(different == 0);
    CHECK(outside > 0);
  }
  // Whatever the place is.
  const TexelImage tiled = [&] {
    std::vector<TexelImage::Tile> tiles;
    tiles.push_back({9, 3, TexelImage(random_picture(random, 2, 2, 4, TexelFormat::floats), false, 1)});
    return TexelImage::of_tiles(std::move(tiles));
  }();
  for (const double u : {std::nan(""), std::numeric_limits<double>::infinity(), -1e30, 1e30, 10.0, 4e9})
    for (const double v : {0.5, std::nan(""), 3.5, 1e30}) {
      std::array<Place, lanes> places{};
      places.fill({u, v, 0, 0});
      CHECK(lane_of(kernel_of(tiled, {}).at(point_of(places)), 0) == Color4{0, 0, 0, 0});
    }
}

TEST_CASE("a lane's colour does not depend on the others, to the bit") {
  std::mt19937 random(41);
  RandomPlaces chance(43);
  const TexelImage image(random_picture(random, 33, 20, 4, TexelFormat::bytes), true, 1);
  const Kernel<Image> kernel = kernel_of(image, with_wrap(Wrap::mirror));
  int different = 0;
  for (int i = 0; i < 50; ++i) {
    auto places = chance.places(2, 0.5);
    for (std::size_t lane = 0; lane < lanes; lane += 2) places[lane].width = places[lane].height = 0;
    const Rgba<FloatN> together = kernel.at(point_of(places));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      std::array<Place, lanes> alone{};
      alone.fill(places[lane]);
      different += lane_of(kernel.at(point_of(alone)), 0) != lane_of(together, lane);
    }
  }
  CHECK(different == 0);
}

TEST_CASE("whatever a lane holds, it reads texels that are there") {
  std::mt19937 random(47);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black})
    for (const TextureFilter filter : {TextureFilter::smart, TextureFilter::nearest}) {
      // All that could be read has one value: what lies beside it has another.
      Picture picture = random_picture(random, 5, 3, 4, TexelFormat::floats);
      for (std::size_t i = 0; i < 5 * 3 * 4; ++i) {
        const float half = 0.5F;
        std::memcpy(picture.pixels.data() + i * sizeof half, &half, sizeof half);
      }
      const TexelImage image(picture, false, 1);
      Image::Parameters parameters = with_wrap(wrap);
      parameters.filter = filter;
      const Kernel<Image> kernel = kernel_of(image, parameters);
      for (const double u : {nan, inf, -inf, 1e30, -1e30, 0.5})
        for (const double width : {nan, inf, 1e30, 0.0}) {
          std::array<Place, lanes> places{};
          places.fill({u, u, width, width});
          const double red = lane_of(kernel.at(point_of(places)), 0)[0];
          INFO(u << ", " << width << ", wrap " << static_cast<int>(wrap));
          CHECK((red == 0.5 || std::isnan(red) || (wrap == Wrap::black && red == 0)));
        }
    }
}

}  // namespace raytrace::test
