#include "raytrace/film/film.h"

#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "raytrace/film/aov_film.h"
#include "raytrace/film/mean.h"
#include "raytrace/film/photons.h"
#include "raytrace/film/splat_layer.h"
#include "raytrace/math/content_hash.h"
#include "raytrace/math/limbs.h"

namespace raytrace {

namespace {

/// Of the next power of two above it.
int exponent_above(float number) {
  int exponent = 0;
  std::frexp(std::min(number, std::numeric_limits<float>::max()), &exponent);
  return exponent;
}

int exponent_for_dimmest(const RadianceRange& range) {
  constexpr int float_bits = 25, least_half = -24;  // one bit more: it is rounded once more as a float
  return std::max(exponent_above(range.dimmest), least_half) - float_bits;
}

/// One exact sum if the pixel has as many samples as there are light paths for each pixel; while a render goes on, the
/// sum of two means. paths: light paths for each pixel; sum: the pixel's, with its numbers of samples.
Pixel mean_with_splats(const RadianceSum& own, const RadianceSum& splat, double paths, const PixelSum& sum,
                       const FilmSettings& settings) {
  const bool is_whole = paths == sum.samples;
  const auto total = [&](std::size_t channel) {
    if (is_whole) return static_cast<double>(own[channel] + splat[channel]);
    const double rest = paths > 0 ? static_cast<double>(splat[channel]) * (sum.samples / paths) : 0;
    return static_cast<double>(own[channel]) + rest;
  };
  return mean(total(0), total(1), total(2), settings.transparent ? sum.hits : sum.samples, sum.samples,
              std::ldexp(1.0, settings.unit_exponent));
}

RadianceSum in_one(const PixelSum& sum, const PixelSumHigh& high) {
  return {from_limbs({sum.red, high.red}), from_limbs({sum.green, high.green}), from_limbs({sum.blue, high.blue})};
}

}  // namespace

int unit_exponent(float largest, std::uint64_t samples) {
  constexpr int sample_bits = 44;  // of a sample of the largest value
  constexpr int count_bits = 63 - sample_bits;
  const int needed_bits = samples > 1 ? static_cast<int>(std::bit_width(samples - 1)) : 0;
  return exponent_above(largest) - sample_bits + std::max(0, needed_bits - count_bits);
}

int unit_exponent(const RadianceRange& range, std::uint64_t samples) {
  const int least = exponent_above(range.largest) - std::ilogb(largest_units) + 1;  // its rounding may exceed it
  return std::max(std::min(unit_exponent(range.usual, samples), exponent_for_dimmest(range)), least);
}

bool is_fine_for_dimmest(const RadianceRange& range, int unit_exponent) {
  return unit_exponent <= exponent_for_dimmest(range);
}

bool is_unit_exponent(int exponent) {
  constexpr auto most_samples = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  return exponent >= unit_exponent(std::numeric_limits<float>::denorm_min(), 1) &&
         exponent <= unit_exponent(std::numeric_limits<float>::max(), most_samples);
}

void Film::set_photons(std::unique_ptr<const Photons> photons) { photons_ = std::move(photons); }

Film::~Film() = default;
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

Film::Film(const FilmSettings& settings, FilmContent content)
    : settings_(settings), content_(content), unit_(std::ldexp(1.0, settings.unit_exponent)) {
  switch (content_) {
    case FilmContent::sums:
      sums_ = LargeArray<PixelSum>::zeros(region().pixels());
      if (settings.light_paths_of)
        splats_ = std::make_unique<SplatLayer>(region(), static_cast<std::uint64_t>(settings.extent.full_width) *
                                                             static_cast<std::uint64_t>(settings.extent.full_height));
      for (const std::string& layer : settings.aovs.layers)
        lights_.push_back({layer, std::make_unique<RadianceLayer>(region()),
                           splats_ ? std::make_unique<RadianceLayer>(region()) : nullptr});
      if (settings.aovs.gather()) aovs_ = std::make_unique<AovFilm>(region(), settings.aovs);
      break;
    case FilmContent::means:
      means_ = LargeArray<Pixel>::zeros(region().pixels());
      break;
    case FilmContent::half_means:
      half_means_ = LargeArray<HalfPixel>::zeros(region().pixels());
      break;
  }
}

Pixel Film::pixel(int x, int y) const {
  switch (content_) {
    case FilmContent::sums:
      if (splats_) {
        const PixelSum& own = sums_[index(x, y)];
        return mean_with_splats(in_one(own, high(x, y)), splats_->sum(x, y), splats_->samples(), own, settings_);
      }
      if (highs_.data() == nullptr) return mean(sums_[index(x, y)], unit_, settings_.transparent);
      return mean(sums_[index(x, y)], high(x, y), unit_, settings_.transparent);
    case FilmContent::means:
      return means_[index(x, y)];
    case FilmContent::half_means:
      break;
  }
  const auto& [red, green, blue, alpha] = half_means_[index(x, y)];
  return {imath_half_to_float(red), imath_half_to_float(green), imath_half_to_float(blue), imath_half_to_float(alpha)};
}

Pixel Film::light_pixel(const LightLayer& light, int x, int y) const {
  const RadianceSum splat = light.splats ? light.splats->sum(x, y) : RadianceSum{};
  const PixelSum& own = sums_[index(x, y)];
  const double paths = splats_ ? splats_->samples() : own.samples;
  return mean_with_splats(light.samples->sum(x, y), splat, paths, own, settings_);
}

void Film::add(int x, int y, const PixelSum& more, const PixelSumHigh& more_high) {
  add(x, y, more);
  if (more_high == PixelSumHigh()) return;
  PixelSumHigh& high = highs_.make(region().pixels())[index(x, y)];
  high.red += more_high.red;
  high.green += more_high.green;
  high.blue += more_high.blue;
}

void Film::carry(int x, int y, const PixelSum& before, const PixelSum& more) {
  PixelSumHigh& high = highs_.make(region().pixels())[index(x, y)];
  const auto carried = [](std::int64_t a, std::int64_t b) {
    std::int64_t sum = 0;
    return !__builtin_add_overflow(a, b, &sum) ? 0 : a < 0 ? -1 : 1;
  };
  high.red += carried(before.red, more.red);
  high.green += carried(before.green, more.green);
  high.blue += carried(before.blue, more.blue);
}

bool Film::has_high() const {
  const PixelSumHigh* const highs = highs_.data();
  return highs != nullptr &&
         std::any_of(highs, highs + region().pixels(), [](const PixelSumHigh& high) { return high != PixelSumHigh(); });
}

void Film::add_to(ContentHash& hash) const {
  hash.add(sums_.data(), sums().size_bytes());
  if (has_high()) hash.add(highs_.data(), region().pixels() * sizeof(PixelSumHigh));
  if (splats_) splats_->add_to(hash);
  for (const LightLayer& light : lights_) {
    light.samples->add_to(hash);
    if (light.splats) light.splats->add_to(hash);
  }
  if (aovs_) aovs_->add_to(hash);
}

std::vector<Pixel> Film::pixels() const {
  std::vector<Pixel> all;
  all.reserve(region().pixels());
  for (int y = region().y0; y < region().y1; ++y)
    for (int x = region().x0; x < region().x1; ++x) all.push_back(pixel(x, y));
  return all;
}

std::uint32_t Film::fewest_samples() const {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  const Region rendered = settings_.rendered();
  for (int y = rendered.y0; y < rendered.y1; ++y)
    for (int x = rendered.x0; x < rendered.x1; ++x) fewest = std::min(fewest, sum(x, y).samples);
  return region().pixels() == 0 || content_ != FilmContent::sums ? 0 : fewest;
}

}  // namespace raytrace
