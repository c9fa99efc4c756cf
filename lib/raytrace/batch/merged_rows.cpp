#include "raytrace/batch/merged_rows.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <variant>
#include <vector>

namespace raytrace {

void fill_missing(ImageBand& band) {
  for_each_pixel(band.region, [&](std::size_t pixel, int x, int y) {
    for (std::size_t i = 0; i < 3; ++i)
      std::get<std::vector<float>>(band.planes[i])[pixel] = ((x ^ y) & 8) == 0 ? 0.1F : 0.2F;
  });
}

void copy_rows(const ImageBand& from, ImageBand& to) {
  const auto width = static_cast<std::size_t>(from.region.width());
  for (std::size_t plane = 0; plane < from.planes.size(); ++plane)
    std::visit(
        [&](const auto& source) {
          auto& target = std::get<std::decay_t<decltype(source)>>(to.planes[plane]);
          for (int y = from.region.y0; y < from.region.y1; ++y) {
            const std::size_t row = from.region.index(from.region.x0, y);
            const std::size_t target_row = to.region.index(from.region.x0, y);
            std::copy_n(source.begin() + static_cast<std::ptrdiff_t>(row), width,
                        target.begin() + static_cast<std::ptrdiff_t>(target_row));
          }
        },
        from.planes[plane]);
}

void copy_means(const Film& sums, ImageBand& band) {
  for_each_pixel(band.region, [&](std::size_t pixel, int x, int y) {
    if (sums.sum(x, y).samples == 0) return;
    const Pixel mean = sums.pixel(x, y);
    std::size_t plane = 0;
    for (const float value : {mean.red, mean.green, mean.blue, mean.alpha})
      std::get<std::vector<float>>(band.planes[plane++])[pixel] = value;
  });
}

}  // namespace raytrace
