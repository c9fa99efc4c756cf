// A finished picture as the tests hold it: pixels of any value, whether rendered or made up.
#pragma once

#include <cstddef>
#include <vector>

#include "raytrace/film/film.h"

namespace raytrace::test {

class FloatPicture {
 public:
  FloatPicture(int full_width, int full_height, const Region& region)
      : extent_{full_width, full_height, region},
        pixels_(static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height())) {}
  FloatPicture(const Film& film) : extent_(film.settings().extent), pixels_(film.pixels()) {}

  const PictureExtent& extent() const { return extent_; }
  const Region& region() const { return extent_.region; }
  const std::vector<Pixel>& pixels() const { return pixels_; }

  Pixel& at(int x, int y) { return pixels_[index(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - region().y0) * static_cast<std::size_t>(region().width()) +
           static_cast<std::size_t>(x - region().x0);
  }

  PictureExtent extent_;
  std::vector<Pixel> pixels_;
};

}  // namespace raytrace::test
