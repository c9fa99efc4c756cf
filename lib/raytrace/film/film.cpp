#include "raytrace/film/film.h"

#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "raytrace/film/aov_film.h"
#include "raytrace/film/film_means.h"

namespace raytrace {

int unit_exponent(float largest_radiance, std::uint64_t samples) {
  constexpr int sample_bits = 44;  // of a sample of the largest radiance
  constexpr int count_bits = 63 - sample_bits;
  int exponent = 0;
  std::frexp(std::min(largest_radiance, std::numeric_limits<float>::max()), &exponent);
  const int needed_bits = samples > 1 ? static_cast<int>(std::bit_width(samples - 1)) : 0;
  return exponent - sample_bits + std::max(0, needed_bits - count_bits);
}

bool is_unit_exponent(int exponent) {
  constexpr auto most_samples = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  return exponent >= unit_exponent(std::numeric_limits<float>::denorm_min(), 1) &&
         exponent <= unit_exponent(std::numeric_limits<float>::max(), most_samples);
}

Film::~Film() = default;
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

Film::Film(const FilmSettings& settings, FilmContent content)
    : settings_(settings), content_(content), unit_(std::ldexp(1.0, settings.unit_exponent)) {
  switch (content_) {
    case FilmContent::sums:
      sums_ = LargeArray<PixelSum>::zeros(count());
      if (settings.aovs.gather()) aovs_ = std::make_unique<AovFilm>(region(), settings.aovs);
      break;
    case FilmContent::means:
      means_ = LargeArray<Pixel>::zeros(count());
      break;
    case FilmContent::half_means:
      half_means_ = LargeArray<HalfPixel>::zeros(count());
      break;
  }
}

Pixel Film::pixel(int x, int y) const {
  switch (content_) {
    case FilmContent::sums:
      return mean(sums_[index(x, y)], unit_, settings_.transparent);
    case FilmContent::means:
      return means_[index(x, y)];
    case FilmContent::half_means:
      break;
  }
  const auto& [red, green, blue, alpha] = half_means_[index(x, y)];
  return {imath_half_to_float(red), imath_half_to_float(green), imath_half_to_float(blue), imath_half_to_float(alpha)};
}

std::vector<Pixel> Film::pixels() const {
  std::vector<Pixel> all;
  all.reserve(count());
  for (int y = region().y0; y < region().y1; ++y)
    for (int x = region().x0; x < region().x1; ++x) all.push_back(pixel(x, y));
  return all;
}

std::uint32_t Film::fewest_samples() const {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  for (const PixelSum& pixel : sums()) fewest = std::min(fewest, pixel.samples);
  return count() == 0 ? 0 : fewest;
}

}  // namespace raytrace
