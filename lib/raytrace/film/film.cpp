#include "raytrace/film/film.h"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>

#include "raytrace/film/aov_film.h"

namespace raytrace {

int unit_exponent(float largest_radiance, std::uint64_t samples) {
  constexpr int sample_bits = 44;  // of a sample of the largest radiance
  constexpr int count_bits = 63 - sample_bits;
  int exponent = 0;
  std::frexp(std::min(largest_radiance, std::numeric_limits<float>::max()), &exponent);
  const int needed_bits = samples > 1 ? static_cast<int>(std::bit_width(samples - 1)) : 0;
  return exponent - sample_bits + std::max(0, needed_bits - count_bits);
}

void Film::Unmap::operator()(PixelSum* sums) const { munmap(sums, bytes); }

Film::~Film() = default;
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

Film::Film(const FilmSettings& settings) : settings_(settings), unit_(std::ldexp(1.0, settings.unit_exponent)) {
  static_assert(std::is_trivially_copyable_v<PixelSum>);
  const std::size_t bytes = count() * sizeof(PixelSum);
  if (bytes == 0) return;
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  sums_ = {static_cast<PixelSum*>(memory), Unmap{bytes}};
  madvise(memory, bytes, MADV_HUGEPAGE);  // where the system has larger pages: fewer to be asked for
  if (settings.aovs.gather()) aovs_ = std::make_unique<AovFilm>(region(), settings.aovs);
}

Pixel Film::pixel(int x, int y) const {
  const PixelSum& pixel = sum(x, y);
  if (pixel.samples == 0) return {};
  const double samples = pixel.samples;
  const auto mean = [&](std::int64_t total) {
    return static_cast<float>(static_cast<double>(total) / samples * unit_);
  };
  return {mean(pixel.red), mean(pixel.green), mean(pixel.blue), static_cast<float>(pixel.hits / samples)};
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
