// What the film keeps, and what it makes of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "raytrace/film/film_means.h"
#include "raytrace/math/content_hash.h"
#include "raytrace/math/limbs.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

FilmSettings settings_of(const Region& region, int unit_exponent) {
  FilmSettings settings;
  settings.extent = {640, 480, region};
  settings.unit_exponent = unit_exponent;
  return settings;
}

/// Adds a sample of red light and its opposite in green.
void add_term(Film& film, int x, int y, Int128 units) {
  const Limbs red = limbs_of(units), green = limbs_of(-units);
  film.add(x, y, {red.low, green.low, 0, 1, 1}, {red.high, green.high, 0});
}

Int128 red_of(const Film& film, int x, int y) { return from_limbs({film.sum(x, y).red, film.high(x, y).red}); }
Int128 green_of(const Film& film, int x, int y) { return from_limbs({film.sum(x, y).green, film.high(x, y).green}); }

std::string hash_of(const Film& film) {
  ContentHash hash;
  film.add_to(hash);
  return hash.digits();
}

}  // namespace

TEST_CASE("a film holds the sums of its region, row by row, under their places in the whole picture") {
  Film film(settings_of({100, 50, 107, 53}, 0));
  CHECK(film.region() == Region{100, 50, 107, 53});
  REQUIRE(film.sums().size() == 21);
  for (const PixelSum& sum : film.sums()) CHECK(sum == PixelSum{});
  for (int y = 50; y < 53; ++y)
    for (int x = 100; x < 107; ++x) film.sum(x, y) += {x, y, 0, 1, 1};
  for (std::size_t i = 0; i < 21; ++i) {
    CHECK(film.sums()[i].red == static_cast<std::int64_t>(100 + i % 7));
    CHECK(film.sums()[i].green == static_cast<std::int64_t>(50 + i / 7));
    CHECK(film.pixels()[i].red == static_cast<float>(100 + i % 7));
  }
}

TEST_CASE("a pixel is the mean of its samples in the film's units, and black and empty without any") {
  Film film(settings_of({0, 0, 2, 1}, -10));
  film.sum(1, 0) += {1024, -512, 3 * 1024, 1, 2};
  film.sum(1, 0) += {1024, -512, 1024, 0, 2};
  const Pixel pixel = film.pixel(1, 0);
  CHECK(pixel.red == 0.5f);
  CHECK(pixel.green == -0.25f);
  CHECK(pixel.blue == 1.0f);
  CHECK(pixel.alpha == 1.0f);
  const Pixel empty = film.pixel(0, 0);
  CHECK(empty.red == 0.0f);
  CHECK(empty.alpha == 0.0f);
  CHECK(film.fewest_samples() == 0);
  film.sum(0, 0).samples = 7;
  CHECK(film.fewest_samples() == 4);
}

TEST_CASE("sums of large terms and small ones are exact, in any order and in any groups") {
  std::mt19937_64 bits(5);
  std::vector<Int128> terms;
  for (int i = 0; i < 300; ++i) {
    const auto small = static_cast<std::int64_t>(bits()) >> 20U;  // up to 2^43, either sign
    terms.insert(terms.end(), {Int128{1} << 60, small, Int128{small} << (bits() % 40)});
  }
  Int128 wanted = 0;
  for (const Int128 term : terms) wanted += term;
  for (int i = 0; i < 5; ++i) {
    Film whole(settings_of({0, 0, 3, 2}, 0));
    std::vector<Film> parts;
    for (int part = 0; part < 4; ++part) parts.emplace_back(whole.settings());
    for (const Int128 term : terms) add_term(parts[bits() % parts.size()], 2, 1, term);
    for (const Film& part : parts) whole.add(2, 1, part.sum(2, 1), part.high(2, 1));
    CHECK((red_of(whole, 2, 1) == wanted));
    CHECK((green_of(whole, 2, 1) == -wanted));
    CHECK(whole.sum(2, 1).samples == terms.size());
    CHECK(whole.sum(1, 1) == PixelSum{});
    CHECK(whole.high(1, 1) == PixelSumHigh{});
    std::shuffle(terms.begin(), terms.end(), bits);
  }
}

TEST_CASE("a sum that leaves 64 bits takes a second limb") {
  constexpr std::int64_t large = std::int64_t{1} << 62;
  Film film(settings_of({0, 0, 2, 1}, 0));
  film.add(1, 0, {large, -large, large, 1, 1});
  film.add(1, 0, {large - 1, -large, -large, 1, 1});
  CHECK(!film.has_high());
  CHECK(film.sum(1, 0) == PixelSum{std::numeric_limits<std::int64_t>::max(), -large - large, 0, 2, 2});
  const std::string before = hash_of(film);
  film.add(1, 0, {1, -1, 1, 0, 0});
  CHECK(film.has_high());
  CHECK((red_of(film, 1, 0) == Int128{1} << 63));
  CHECK((green_of(film, 1, 0) == -(Int128{1} << 63) - 1));
  CHECK(film.high(1, 0).blue == 0);
  CHECK(hash_of(film) != before);
  film.add(1, 0, {-1, 1, -1, 0, 0});
  CHECK(!film.has_high());
  CHECK(hash_of(film) == before);  // whether it ever had one
  Film taken = std::move(film);
  CHECK((green_of(taken, 1, 0) == -(Int128{1} << 63)));
}

TEST_CASE("means are of both limbs") {
  Film film(settings_of({0, 0, 1, 1}, -70));
  for (int i = 0; i < 3; ++i) add_term(film, 0, 0, Int128{3} << 80);
  add_term(film, 0, 0, Int128{-1} << 80);
  CHECK(film.pixel(0, 0).red == 2048);
  CHECK(film.pixel(0, 0).green == -2048);
}

TEST_CASE("threads may be the first to need a second limb at the same time") {
  constexpr int threads = 4, width = 64;
  for (int round = 0; round < 20; ++round) {
    Film film(settings_of({0, 0, width, 1}, 0));
    std::vector<std::thread> workers;
    for (int thread = 0; thread < threads; ++thread)
      workers.emplace_back([&film, thread] {
        for (int x = thread; x < width; x += threads) add_term(film, x, 0, Int128{x + 1} << 70);
      });
    for (std::thread& worker : workers) worker.join();
    int wrong = 0;
    for (int x = 0; x < width; ++x) wrong += red_of(film, x, 0) != Int128{x + 1} << 70;
    CHECK(wrong == 0);
  }
}

TEST_CASE("alpha is coverage in a transparent picture") {
  FilmSettings settings = settings_of({0, 0, 2, 1}, -10);
  settings.transparent = true;
  Film film(settings);
  film.sum(1, 0) += {1024, -512, 3 * 1024, 1, 4};
  CHECK(film.pixel(1, 0).alpha == 0.25f);
  CHECK(film.pixel(1, 0).red == 0.25f);  // premultiplied
  CHECK(film.pixel(0, 0).alpha == 0.0f);
}

TEST_CASE("a film of means takes those of sums, as floats or as halves") {
  const std::uint32_t samples = GENERATE(1U, 3U, 4U);
  const Region region{10, 20, 17, 26}, part{12, 21, 16, 25};
  Film sums(settings_of(part, -10));
  std::int64_t next = 1;
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x, next *= 3) sums.sum(x, y) += {next, -next, next * next, 2, samples};
  for (const FilmContent content : {FilmContent::means, FilmContent::half_means}) {
    Film means(settings_of(region, -10), content);
    CHECK(means.sums().empty());
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x) set_means(means, x, y, 1, [&](int) { return sums.pixel(x, y); });
    for (int y = region.y0; y < region.y1; ++y)
      for (int x = region.x0; x < region.x1; ++x) {
        INFO(x << ", " << y);
        const bool inside = part.x0 <= x && x < part.x1 && part.y0 <= y && y < part.y1;
        const Pixel wanted = inside ? sums.pixel(x, y) : Pixel(), got = means.pixel(x, y);
        const auto same = [&](float Pixel::* channel) {
          if (content == FilmContent::means || wanted.*channel == 0) return got.*channel == wanted.*channel;
          constexpr float largest = 65504, steps = 0x1p-11F;  // of half
          return std::abs(wanted.*channel) > largest
                     ? std::isinf(got.*channel) && std::signbit(got.*channel) == std::signbit(wanted.*channel)
                     : std::abs(got.*channel / (wanted.*channel) - 1) <= steps;
        };
        CHECK(same(&Pixel::red));
        CHECK(same(&Pixel::green));
        CHECK(same(&Pixel::blue));
        CHECK(same(&Pixel::alpha));
      }
  }
}

TEST_CASE("a film's unit leaves room for the sums, and is the same for all parts of a picture") {
  for (const float largest : {1e-20f, 0.7f, 1.0f, 1.5f, 1e17f, std::numeric_limits<float>::max()})
    for (const double samples : {1.0, 16.0, 524288.0, 524289.0, 1e7, 4294967295.0}) {
      const int exponent = unit_exponent(largest, static_cast<std::uint64_t>(samples));
      const double sum = std::ldexp(static_cast<double>(largest), -exponent) * samples;
      INFO(largest << " x " << samples << ": 2^" << exponent);
      CHECK(sum <= 0x1p63);
      CHECK(std::ldexp(static_cast<double>(largest), -exponent) <= 0x1p44);
      if (samples <= 524288) CHECK(exponent == unit_exponent(largest, 1));
      if (samples <= 524288) CHECK(std::ldexp(static_cast<double>(largest), -exponent) >= 0x1p43);
    }
  CHECK(unit_exponent(0, 1) == unit_exponent(0, 1000));
  CHECK(unit_exponent(std::numeric_limits<float>::infinity(), 1) ==
        unit_exponent(std::numeric_limits<float>::max(), 1));
}

}  // namespace raytrace::test
