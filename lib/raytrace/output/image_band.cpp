#include "raytrace/output/image_band.h"

#include <algorithm>
#include <array>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

std::vector<Channel> color_channels(bool full_float) {
  const ChannelType type = full_float ? ChannelType::float32 : ChannelType::half;
  return {{"R", type}, {"G", type}, {"B", type}, {"A", type}};
}

void make_planes(ImageBand& band, std::size_t first_plane, const std::vector<Channel>& channels) {
  const auto pixels = static_cast<std::size_t>(band.region.width()) * static_cast<std::size_t>(band.region.height());
  band.planes.resize(std::max(band.planes.size(), first_plane + channels.size()));
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].type == ChannelType::uint32) {
      band.planes[first_plane + i] = std::vector<std::uint32_t>(pixels);
    } else {
      band.planes[first_plane + i] = std::vector<float>(pixels);
    }
  }
}

int band_rows(int width, std::size_t channels) {
  constexpr std::size_t most_values = 4U << 20U;
  constexpr std::size_t block_rows = 16, most_blocks = 16;
  const std::size_t block_values = channels * static_cast<std::size_t>(width) * block_rows;
  return static_cast<int>(std::clamp<std::size_t>(most_values / block_values, 1, most_blocks) * block_rows);
}

void fill_color(ImageBand& band, const Film& film, int y0, int y1, int threads) {
  band.region = {film.region().x0, y0, film.region().x1, y1};
  band.planes.resize(std::max(band.planes.size(), ImageBand::colors));
  band.half_colors = film.content() == FilmContent::half_means ? film.half_mean(band.region.x0, y0).data() : nullptr;
  if (band.half_colors != nullptr) return;
  const auto width = static_cast<std::size_t>(band.region.width());
  std::array<float*, ImageBand::colors> planes;
  for (std::size_t i = 0; i < ImageBand::colors; ++i) {
    if (!std::holds_alternative<std::vector<float>>(band.planes[i])) band.planes[i] = std::vector<float>();
    auto& plane = std::get<std::vector<float>>(band.planes[i]);
    plane.resize(width * static_cast<std::size_t>(band.region.height()));
    planes[i] = plane.data();
  }
  for_each_index(band.region.height(), threads, [&](int row) {
    std::size_t at = static_cast<std::size_t>(row) * width;
    for (int x = band.region.x0; x < band.region.x1; ++x, ++at) {
      const Pixel pixel = film.pixel(x, y0 + row);
      planes[0][at] = pixel.red;
      planes[1][at] = pixel.green;
      planes[2][at] = pixel.blue;
      planes[3][at] = pixel.alpha;
    }
  });
}

}  // namespace raytrace
