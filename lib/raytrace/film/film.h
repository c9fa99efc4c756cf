// The picture in memory: linear radiance and coverage of each pixel of a region.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace raytrace {

/// Pixels [x0, x1) x [y0, y1); the origin is the picture's top left corner.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  friend bool operator==(const Region&, const Region&) = default;
};

/// The whole picture's size, and the part of it that is rendered.
struct PictureExtent {
  int full_width = 0, full_height = 0;
  Region region;
};

/// Linear RGB radiance, and A: the part of the pixel's samples that hit an object.
struct Pixel {
  float red = 0, green = 0, blue = 0, alpha = 0;
};

/// Holds the finished pixels of `region`, a part of a picture of full_width x full_height; they are black and empty at
/// first. Threads may write different pixels at the same time.
class Film {
 public:
  /// Throws std::bad_alloc.
  Film(int full_width, int full_height, Region region);

  int full_width() const { return full_width_; }
  int full_height() const { return full_height_; }
  const Region& region() const { return region_; }

  /// x, y: in the whole picture, inside region().
  Pixel& at(int x, int y) { return pixels_[index(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels_[index(x, y)]; }

  /// Row by row from the region's top, each from its left.
  std::span<const Pixel> pixels() const { return {pixels_.get(), count()}; }

 private:
  struct Unmap {
    std::size_t bytes;
    void operator()(Pixel* pixels) const;
  };

  std::size_t count() const {
    return static_cast<std::size_t>(region_.width()) * static_cast<std::size_t>(region_.height());
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - region_.y0) * static_cast<std::size_t>(region_.width()) +
           static_cast<std::size_t>(x - region_.x0);
  }

  int full_width_, full_height_;
  Region region_;
  /// Zeros from the system, page by page as they are first written: by the threads that render, not by the one that
  /// makes the film.
  std::unique_ptr<Pixel[], Unmap> pixels_;
};

}  // namespace raytrace
