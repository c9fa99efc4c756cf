#include "raytrace/film/aov_film.h"

#include <algorithm>
#include <array>
#include <random>

#include "raytrace/output/image_band.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

AovSettings some_settings() {
  AovSettings settings;
  settings.nearest_values = 2;
  settings.mean_units = {-40, -41, -42};
  settings.coverages = 2;
  return settings;
}

bool same(const AovFilm& a, const AovFilm& b) {
  const Region& region = a.region();
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      const AovFilm::Nearest one = a.nearest(x, y), other = b.nearest(x, y);
      if ((one.values == nullptr) != (other.values == nullptr)) return false;
      if (one.values != nullptr && (one.sample != other.sample || one.depth != other.depth ||
                                    !std::equal(one.values, one.values + 2, other.values)))
        return false;
      for (std::size_t i = 0; i < 3; ++i)
        if (a.sum(x, y, i) != b.sum(x, y, i)) return false;
      for (std::size_t i = 0; i < 2; ++i)
        if (a.ranked(x, y, i) != b.ranked(x, y, i)) return false;
    }
  return true;
}

struct Sample {
  int x, y;
  std::uint32_t index;
  float depth;
  std::array<std::uint32_t, 2> values;
  std::int64_t mean;
  IdCount id;
};

/// Few depths and ids, so that many are equal.
std::vector<Sample> random_samples(const Region& region, int count) {
  std::mt19937 bits(7);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(bits() % n); };
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const int x = region.x0 + static_cast<int>(below(static_cast<std::uint32_t>(region.width())));
    const int y = region.y0 + static_cast<int>(below(static_cast<std::uint32_t>(region.height())));
    samples.push_back({x,
                       y,
                       static_cast<std::uint32_t>(i),
                       static_cast<float>(below(5)),
                       {below(1000), below(1000)},
                       static_cast<std::int64_t>(below(1U << 31U)) * 1000003 - (std::int64_t{1} << 50U),
                       {0x3f800000U + below(9), 1 + below(3)}});
  }
  return samples;
}

void add(AovFilm& film, const Sample& sample) {
  film.add_nearest(sample.x, sample.y, sample.depth, sample.index, sample.values.data());
  film.add_mean(sample.x, sample.y, sample.index % 3, sample.mean);
  film.add_coverage(sample.x, sample.y, sample.index % 2, sample.id);
}

}  // namespace

TEST_CASE("the nearest sample stays, and of equally near ones the first") {
  AovFilm film({3, 4, 5, 6}, some_settings());
  CHECK(film.nearest(4, 5).values == nullptr);
  const std::uint32_t a[] = {1, 2}, b[] = {3, 4}, c[] = {5, 6}, d[] = {7, 8};
  film.add_nearest(4, 5, 2.5F, 9, a);
  film.add_nearest(4, 5, 3.5F, 0, b);
  CHECK(film.nearest(4, 5).values[0] == 1);
  film.add_nearest(4, 5, 2.5F, 8, c);
  film.add_nearest(4, 5, 2.5F, 10, d);
  CHECK(film.nearest(4, 5).values[1] == 6);
  CHECK(film.nearest(4, 5).sample == 8);
  CHECK(film.nearest(3, 5).values == nullptr);
}

TEST_CASE("ids are ranked by their counts, equal ones by the id") {
  AovFilm film({0, 0, 1, 1}, some_settings());
  for (const IdCount& one : {IdCount{7, 2}, {5, 1}, {9, 3}, {5, 1}, {1, 1}, {9, 1}}) film.add_coverage(0, 0, 1, one);
  CHECK(film.ranked(0, 0, 1) == std::vector<IdCount>{{9, 4}, {5, 2}, {7, 2}, {1, 1}});
  CHECK(film.ranked(0, 0, 0).empty());
}

TEST_CASE("what AOVs gather does not depend on the order of samples, nor on how they are split and put together") {
  const Region region{10, 20, 17, 25};
  std::vector<Sample> samples = random_samples(region, 2000);
  AovFilm wanted(region, some_settings());
  for (const Sample& sample : samples) add(wanted, sample);

  std::mt19937 bits(3);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(samples.begin(), samples.end(), bits);
    FilmSettings settings;
    settings.extent.region = region;
    settings.aovs = some_settings();
    std::vector<Film> parts;
    for (int part = 0; part < 4; ++part) {
      const PixelSum all{0, 0, 0, 0, 2000};
      for_each_pixel(region,
                     [film = &parts.emplace_back(settings), &all](std::size_t, int x, int y) { film->add(x, y, all); });
    }
    for (const Sample& sample : samples) add(*parts[bits() % 4].aovs(), sample);
    Film merged(settings);
    for (const Film& part : parts) {  // through channels, as pieces are merged
      const std::vector<Channel> channels = sum_channels(part);
      for (int y = region.y0; y < region.y1; y += 2) {
        ImageBand band{{region.x0, y, region.x1, std::min(y + 2, region.y1)}, {}};
        append_sums(band, channels, part);
        CHECK(add_sums(band, channels, {0, 2000}, merged));
      }
    }
    CHECK(same(*merged.aovs(), wanted));
  }
  AovFilm other(region, some_settings());
  for (const Sample& sample : samples) add(other, sample);
  CHECK(same(other, wanted));
  other.add_mean(12, 22, 1, 1);
  CHECK(!same(other, wanted));  // the comparison can fail
}

}  // namespace raytrace::test
