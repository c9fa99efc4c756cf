// The picture in memory: linear radiance and coverage of each pixel of a region.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace raytrace {

/// Pixels [x0, x1) x [y0, y1); the origin is the picture's top left corner.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  friend bool operator==(const Region&, const Region&) = default;
};

/// Linear RGB radiance, and A: the part of the pixel's samples that hit an object.
struct Pixel {
  float red = 0, green = 0, blue = 0, alpha = 0;
};

/// Holds the finished pixels of `region`, a part of a picture of full_width x full_height.
/// Threads may write different pixels at the same time.
class Film {
 public:
  Film(int full_width, int full_height, Region region)
      : full_width_(full_width),
        full_height_(full_height),
        region_(region),
        pixels_(static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height())) {}

  int full_width() const { return full_width_; }
  int full_height() const { return full_height_; }
  const Region& region() const { return region_; }

  /// x, y: in the whole picture, inside region().
  Pixel& at(int x, int y) { return pixels_[index(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels_[index(x, y)]; }

  /// Row by row from the region's top, each from its left.
  std::span<const Pixel> pixels() const { return pixels_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - region_.y0) * static_cast<std::size_t>(region_.width()) +
           static_cast<std::size_t>(x - region_.x0);
  }

  int full_width_, full_height_;
  Region region_;
  std::vector<Pixel> pixels_;
};

}  // namespace raytrace
