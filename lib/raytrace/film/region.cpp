#include "raytrace/film/region.h"

#include <array>
#include <charconv>

namespace raytrace {

std::string text_of(const Region& r) {
  return std::to_string(r.x0) + "," + std::to_string(r.y0) + "," + std::to_string(r.x1) + "," + std::to_string(r.y1);
}

std::optional<Region> region_of(std::string_view text) {
  std::array<int, 4> edges{};
  const char* next = text.data();
  const char* const end = next + text.size();
  for (int& edge : edges) {
    const auto [stop, error] = std::from_chars(next, end, edge);
    if (error != std::errc()) return std::nullopt;
    next = stop == end ? end : stop + 1;
  }
  const Region region{edges[0], edges[1], edges[2], edges[3]};
  if (text_of(region) != text) return std::nullopt;
  return region;
}

std::optional<std::string> crop_error(const Region& crop, int width, int height) {
  if (crop.x0 >= crop.x1 || crop.y0 >= crop.y1) return "it holds no pixel: x1 must be above x0, and y1 above y0";
  if (!contains({-width, -height, 2 * width, 2 * height}, crop))
    return "it reaches outside the picture of " + std::to_string(width) + " x " + std::to_string(height) +
           " pixels by more than the picture's own size";
  if (!is_allowed_size(crop.width(), crop.height()))
    return "its " + std::to_string(crop.width()) + " x " + std::to_string(crop.height()) +
           " pixels are too many; the most is " + std::to_string(largest_edge) + " along an edge and " +
           std::to_string(static_cast<long long>(most_pixels)) + " in all";
  return std::nullopt;
}

}  // namespace raytrace
