#include "raytrace/output/image_band.h"

#include <algorithm>

namespace raytrace {

namespace {

constexpr std::size_t colors = 4;

}  // namespace

std::vector<Channel> color_channels(bool full_float) {
  const ChannelType type = full_float ? ChannelType::float32 : ChannelType::half;
  return {{"R", type}, {"G", type}, {"B", type}, {"A", type}};
}

int band_rows(int width, std::size_t channels) {
  constexpr std::size_t most_values = 4U << 20U;
  constexpr std::size_t block_rows = 16;
  const std::size_t block_values = channels * static_cast<std::size_t>(width) * block_rows;
  return static_cast<int>(std::max<std::size_t>(1, most_values / block_values) * block_rows);
}

void fill_color(ImageBand& band, const Film& film, int y0, int y1) {
  band.region = {film.region().x0, y0, film.region().x1, y1};
  band.planes.resize(std::max(band.planes.size(), colors));
  const auto values = static_cast<std::size_t>(band.region.width()) * static_cast<std::size_t>(band.region.height());
  float* next[colors];
  for (std::size_t i = 0; i < colors; ++i) {
    if (!std::holds_alternative<std::vector<float>>(band.planes[i])) band.planes[i] = std::vector<float>();
    auto& plane = std::get<std::vector<float>>(band.planes[i]);
    plane.resize(values);
    next[i] = plane.data();
  }
  for (int y = y0; y < y1; ++y) {
    for (int x = band.region.x0; x < band.region.x1; ++x) {
      const Pixel pixel = film.pixel(x, y);
      *next[0]++ = pixel.red;
      *next[1]++ = pixel.green;
      *next[2]++ = pixel.blue;
      *next[3]++ = pixel.alpha;
    }
  }
}

}  // namespace raytrace
