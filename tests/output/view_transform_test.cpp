// View transforms against their published formulas, the exposure that a picture asks for, and both in files.
#include "raytrace/output/view_transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "pictures.h"
#include "raytrace/math/srgb.h"
#include "raytrace/output/auto_exposure.h"
#include "raytrace/output/pixel_format.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

using Triple = std::array<double, 3>;

Triple parts(const Rgb<double>& color) { return {color.red, color.green, color.blue}; }

/// The Khronos PBR Neutral Tone Mapper as its sample implementation (pbrNeutral.glsl) has it, step by step.
Triple reference_neutral(Triple color) {
  const double x = *std::min_element(color.begin(), color.end());
  const double offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
  for (double& part : color) part -= offset;
  const double peak = *std::max_element(color.begin(), color.end());
  if (peak < 0.76) return color;
  const double d = 1 - 0.76, new_peak = 1 - d * d / (peak + d - 0.76);
  const double g = 1 - 1 / (0.15 * (peak - new_peak) + 1);
  for (double& part : color) part = part * (new_peak / peak) * (1 - g) + new_peak * g;
  return color;
}

/// AgX as https://github.com/allenwp/AgX-GLSL-Shaders derives it from Blender's: matrices multiplied out, and the
/// curve's constants as numbers. Columns of the matrices, as in GLSL; they take white off by 0.0002.
Triple reference_agx(const Triple& color) {
  constexpr double in[3][3] = {{0.54490813676363087053, 0.14044005884001287035, 0.088827411851915368603},
                               {0.37377945959812267119, 0.75410959864013760045, 0.17887712465043811023},
                               {0.081384976686407536266, 0.10543358536857773485, 0.73224999956948382528}};
  constexpr double out[3][3] = {{1.9645509602733325934, -0.29932243390911083839, -0.16436833806080403409},
                                {-0.85585845117807513559, 1.3264510741502356555, -0.23822464068860595117},
                                {-0.10886710826831608324, -0.027084020983874825605, 1.402665347143271889}};
  constexpr double pivot = 10 / 16.5;
  Triple formed{}, result{};
  for (std::size_t i = 0; i < 3; ++i) {
    double part = 0;
    for (std::size_t k = 0; k < 3; ++k) part += in[k][i] * std::max(color[k], 2e-10);
    const double x = std::clamp((std::log2(part / 0.18) + 10) / 16.5, 0.0, 1.0);
    const double a =
        x < pivot ? (10.858542784410849080 - 1 / std::pow(pivot, 1.5)) * std::pow(pivot - x, 1.5)
                  : (-1 + 10.191614048660063014 * std::pow(1 - pivot, 1.5)) * std::pow((x - pivot) / (1 - pivot), 1.5);
    const double y = 0.48943708957387834110 + 2.4 * (x - pivot) / std::pow(1 + a, 1 / 1.5);
    formed[i] = std::pow(std::max(y, 0.0), 2.4);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) result[i] += out[k][i] * formed[k];
    result[i] = std::clamp(result[i], 0.0, 1.0);
  }
  return result;
}

Triple transformed(ViewTransform transform, const Triple& color) {
  return parts(view_transformed(transform, {color[0], color[1], color[2]}));
}

double grey(ViewTransform transform, double value) {
  const Triple color = transformed(transform, {value, value, value});
  CHECK(std::abs(color[0] - color[1]) < 1e-6);
  CHECK(std::abs(color[0] - color[2]) < 1e-6);
  return color[1];
}

double luminance(const Triple& color) { return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]; }

FloatPicture even_picture(int size, const Pixel& pixel) {
  FloatPicture picture(size, size, {0, 0, size, size});
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) picture.at(x, y) = pixel;
  return picture;
}

}  // namespace

TEST_CASE("view transforms follow their published formulas") {
  const auto [transform, tolerance, reference] = GENERATE(table<ViewTransform, double, Triple (*)(const Triple&)>(
      {{ViewTransform::agx, 3e-4, reference_agx},
       {ViewTransform::khronos_neutral, 1e-12, [](const Triple& color) { return reference_neutral(color); }}}));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> stops(-14, 8), share(0, 1);
  for (int i = 0; i < 20'000; ++i) {
    const double brightness = std::exp2(stops(random));
    const Triple color = {brightness * share(random), brightness * share(random), brightness * share(random)};
    const Triple got = transformed(transform, color), wanted = reference(color);
    for (std::size_t k = 0; k < 3; ++k) {
      INFO(color[0] << " " << color[1] << " " << color[2] << ", part " << k);
      REQUIRE(std::abs(got[k] - wanted[k]) < tolerance);
      REQUIRE(got[k] >= 0);
      REQUIRE(got[k] <= 1);
    }
  }
}

TEST_CASE("khronos-neutral shows base colours as they are, less the reflection of white surroundings") {
  // As its specification has it: above 0.08, 0.04 is taken away, up to 0.8.
  for (const Triple& base : {Triple{0.76, 0.04, 0.3}, Triple{0.5, 0.5, 0.5}, Triple{0.04, 0.7, 0.04}}) {
    const Triple lit = {base[0] + 0.04, base[1] + 0.04, base[2] + 0.04};
    const Triple got = transformed(ViewTransform::khronos_neutral, lit);
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(got[k] - base[k]) < 1e-15);
  }
  // On paper: 0.04 - 0.03; 1 - 0.24^2 / 0.44; 1 - 0.24^2 / (9.96 - 0.52).
  CHECK(std::abs(grey(ViewTransform::khronos_neutral, 0.04) - 0.01) < 1e-15);
  CHECK(std::abs(grey(ViewTransform::khronos_neutral, 1) - (1 - 0.0576 / 0.44)) < 1e-15);
  CHECK(std::abs(grey(ViewTransform::khronos_neutral, 10) - (1 - 0.0576 / 9.44)) < 1e-15);
}

TEST_CASE("agx leaves middle grey, and its ends are 10 stops below it and 6.5 above") {
  CHECK(std::abs(grey(ViewTransform::agx, 0.18) - 0.18) < 1e-6);
  CHECK(grey(ViewTransform::agx, 0.18 * std::exp2(-10)) < 1e-9);
  CHECK(grey(ViewTransform::agx, 0.18 * std::exp2(-9)) > 1e-6);
  CHECK(grey(ViewTransform::agx, 0.18 * std::exp2(6.5)) > 1 - 1e-6);
  CHECK(grey(ViewTransform::agx, 0.18 * std::exp2(5.5)) < 0.999);
  // What is far too bright is white, whatever its colour.
  for (const double part : transformed(ViewTransform::agx, {1e5, 50, 50})) CHECK(part > 0.99);
}

TEST_CASE("grey stays grey, brighter stays brighter, black stays black") {
  const ViewTransform transform = GENERATE(ViewTransform::agx, ViewTransform::khronos_neutral);
  CHECK(grey(transform, 0) == 0);
  CHECK(grey(transform, -1) == 0);
  double before = -1e-12;
  for (double stops = -10; stops < 8; stops += 1.0 / 64) {
    const double value = grey(transform, 0.18 * std::exp2(stops));
    REQUIRE(value > before - 1e-12);
    before = value;
  }
  const double largest{std::numeric_limits<float>::max()};
  CHECK(grey(transform, largest) <= 1);
  CHECK(grey(transform, largest) > 0.999);
  // A colour's luminance grows with it, too.
  for (const Triple& color : {Triple{1, 0.1, 0.05}, Triple{0.1, 0.3, 1}, Triple{0.5, 1, 0.2}}) {
    double last = 0;
    for (double stops = -8; stops < 8; stops += 1.0 / 16) {
      const double scale = std::exp2(stops);
      const double value = luminance(transformed(transform, {color[0] * scale, color[1] * scale, color[2] * scale}));
      REQUIRE(value > last - 1e-4);
      last = value;
    }
  }
  CHECK(transformed(ViewTransform::srgb, {-1, 0.5, 7}) == Triple{-1, 0.5, 7});
}

TEST_CASE("files for display hold the exposed, transformed and encoded colour of the covered part") {
  const TemporaryFolder folder;
  ImageFileSettings settings;
  settings.view_transform = GENERATE(ViewTransform::agx, ViewTransform::khronos_neutral);
  settings.bit_depth = GENERATE(8, 16);
  settings.exposure = 0.5;
  settings.transparent = true;
  const char* const name = GENERATE("a.png", "a.tif");
  FloatPicture film(4, 1, {0, 0, 4, 1});
  film.at(0, 0) = {0, 0, 0, 0};
  film.at(1, 0) = {0.25F, 0.1F, 0, 0.5F};
  film.at(2, 0) = {5, 0.125F, 0.03F, 0.25F};
  film.at(3, 0) = {0.25F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1};
  const Repairs repairs = write_image(folder.file(name), film, {}, settings);
  CHECK(repairs.not_finite == 2);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const ReadPicture picture = read_picture(folder.file(name), &config);
  const double most = settings.bit_depth == 8 ? 255 : 65535;
  for (int x = 1; x < 4; ++x) {
    const Pixel& pixel = film.at(x, 0);
    const double factor = std::exp2(0.5) / double{pixel.alpha};
    Triple color = {double{pixel.red} * factor, double{pixel.green} * factor, double{pixel.blue} * factor};
    if (x == 3) color = {color[0], 1e38, 0};
    const Triple shown = transformed(settings.view_transform, color);
    for (int k = 0; k < 3; ++k) {
      INFO(name << " " << x << " " << k);
      const double wanted = double{srgb_of_linear(static_cast<float>(shown[static_cast<std::size_t>(k)]))} * most;
      CHECK(std::abs(double{picture.value(x, 0, k)} * most - wanted) < 0.51);
    }
    CHECK(std::abs(picture.value(x, 0, 3) - pixel.alpha) < 0.01F);
  }
}

TEST_CASE("files for display say through which view they show the picture, and linear ones have none") {
  const TemporaryFolder folder;
  ImageFileSettings settings;
  settings.view_transform = ViewTransform::agx;
  settings.exposure = -1.25;
  settings.auto_exposure = 0.5;
  const FloatPicture film = distinct_film(4, 4);
  for (const char* const name : {"a.png", "a.tif", "a.exr", "a.hdr"})
    write_image(folder.file(name), film, some_metadata(), settings);
  const OIIO::ImageSpec png = read_picture(folder.file("a.png")).spec;
  CHECK(png.get_string_attribute("raytrace:viewTransform") == "agx");
  CHECK(png.get_string_attribute("raytrace:exposure") == "-1.25");
  CHECK(png.get_string_attribute("raytrace:autoExposure") == "0.5");
  CHECK(contains(read_picture(folder.file("a.tif")).spec.get_string_attribute("ImageDescription").c_str(),
                 "view transform agx, exposure -1.25"));
  settings.full_float = true;
  write_image(folder.file("a.exr"), film, {}, settings);
  const ReadPicture exr = read_picture(folder.file("a.exr"));
  CHECK(exr.spec.find_attribute("raytrace:viewTransform") == nullptr);
  CHECK(exr.value(3, 2, 0) == film.at(3, 2).red);
  CHECK(std::abs(read_picture(folder.file("a.hdr")).value(3, 2, 0) / film.at(3, 2).red - 1) < 0.01F);
}

TEST_CASE("a picture asks for the exposure that makes its logarithmic mean 0.18") {
  const auto asked = [](const FloatPicture& picture) {
    AutoExposure exposure;
    exposure.add(color_band(picture));
    return exposure.stops();
  };
  CHECK(asked(even_picture(4, {0.18F, 0.18F, 0.18F, 1})) == 0);
  CHECK(asked(even_picture(4, {0.36F, 0.36F, 0.36F, 1})) == -1);
  CHECK(asked(even_picture(4, {0.09F, 0.09F, 0.09F, 1})) == 1);
  CHECK(asked(even_picture(4, {0.18F, 0, 0, 1})) == 2.23);          // -log2(0.2126), in hundredths
  CHECK(asked(even_picture(4, {0.09F, 0.09F, 0.09F, 0.5F})) == 0);  // the covered part
  CHECK(asked(even_picture(4, {0, 0, 0, 1})) == 0);
  CHECK(asked(even_picture(4, {1, 1, 1, 0})) == 0);
  CHECK(asked(even_picture(4, {1e-38F, 1e-38F, 1e-38F, 1})) == 64);
  FloatPicture picture = even_picture(4, {0.09F, 0.09F, 0.09F, 1});
  for (int x = 0; x < 4; ++x) picture.at(x, 0) = {0.72F, 0.72F, 0.72F, 1};  // a quarter of it, 3 stops more
  CHECK(asked(picture) == 0.25);
  // What is black, not finite or not covered does not count.
  for (int x = 0; x < 4; ++x) picture.at(x, 1) = {0, 0, 0, 1};
  picture.at(0, 1) = {std::numeric_limits<float>::infinity(), 1, 1, 1};
  picture.at(1, 1) = {std::numeric_limits<float>::quiet_NaN(), 1, 1, 1};
  picture.at(2, 1) = {5, 5, 5, 0};
  CHECK(asked(picture) == 0);
}

TEST_CASE("the exposure that a picture asks for does not depend on the order of its pixels") {
  const FloatPicture picture = noise_film(64, 48);
  AutoExposure rows, columns;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) rows.add(picture.at(x, y));
  for (int x = 63; x >= 0; --x)
    for (int y = 0; y < 48; ++y) columns.add(picture.at(x, y));
  CHECK(rows.stops() == columns.stops());
  CHECK(rows.stops() != 0);
}

}  // namespace raytrace::test
