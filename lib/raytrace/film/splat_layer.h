// What light paths bring to a film: unlike a pixel's own samples, they reach any pixel.
#pragma once

#include <atomic>
#include <cstdint>

#include "raytrace/film/radiance_layer.h"

namespace raytrace {

class SplatLayer : public RadianceLayer {
 public:
  /// region: of the film; picture_pixels: of the whole picture, which is how many light paths there are for each sample
  /// of a pixel. Throws std::bad_alloc.
  SplatLayer(const Region& region, std::uint64_t picture_pixels)
      : RadianceLayer(region), picture_pixels_(picture_pixels) {}

  /// Pixels of the region share all light paths among them, whatever part of the picture it is: pixel k of n, row by
  /// row, has those of the picture's pixels k, k + n, k + 2 n..., one for each of its samples. How many of them: in
  /// most films one.
  std::uint64_t paths_per_sample(int x, int y) const {
    const std::uint64_t first = region().index(x, y);
    return first < picture_pixels_ ? (picture_pixels_ - first - 1) / region().pixels() + 1 : 0;
  }
  /// The picture's pixel, counted row by row, that path i of those belongs to.
  std::uint64_t path_pixel(int x, int y, std::uint64_t i) const { return region().index(x, y) + i * region().pixels(); }

  /// Counts light paths, each with all that it brought.
  void add_paths(std::uint64_t paths) { paths_.fetch_add(paths, std::memory_order_relaxed); }
  /// How many samples of each pixel of the picture these are.
  double samples() const {
    return static_cast<double>(paths_.load(std::memory_order_relaxed)) / static_cast<double>(picture_pixels_);
  }

 private:
  std::uint64_t picture_pixels_;
  std::atomic<std::uint64_t> paths_{0};
};

}  // namespace raytrace
