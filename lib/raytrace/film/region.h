// Rectangles of a picture's pixels, and which of them may be rendered.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace raytrace {

/// Pixels [x0, x1) x [y0, y1); the origin is the picture's top left corner. What lies beyond the picture (overscan) has
/// coordinates below 0, or from its width or height on.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  std::size_t pixels() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }
  /// A pixel's number, row by row.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x - x0);
  }
  friend bool operator==(const Region&, const Region&) = default;
};

constexpr bool contains(const Region& outer, const Region& inner) {
  return outer.x0 <= inner.x0 && outer.y0 <= inner.y0 && inner.x1 <= outer.x1 && inner.y1 <= outer.y1;
}

/// "x0,y0,x1,y1"
std::string text_of(const Region& region);

/// The other way round; none if text_of() would not give that very text.
std::optional<Region> region_of(std::string_view text);

/// The largest multiple of `step` (above 0) that is not above `value`, which may be negative.
constexpr int round_down(int value, int step) { return value - (value % step + step) % step; }

/// No picture's edge has more pixels, and no picture more in all: 16384 x 16384.
inline constexpr int largest_edge = 65536;
inline constexpr double most_pixels = 268435456;

constexpr bool is_allowed_size(double width, double height) {
  return width >= 1 && height >= 1 && width <= largest_edge && height <= largest_edge && width * height <= most_pixels;
}

/// Why this part of a picture of width x height pixels cannot be rendered; none if it can. It may reach beyond the
/// picture, by at most the picture's size on each side.
std::optional<std::string> crop_error(const Region& crop, int width, int height);

}  // namespace raytrace
