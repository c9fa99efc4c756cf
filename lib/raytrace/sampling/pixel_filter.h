// Pixel filters, by placing samples: where a filter is high, more of them are (Ernst, Stamminger, Greiner, "Filter
// Importance Sampling", 2006). All count alike, so that a pixel has its own samples and no others.
#pragma once

#include <array>
#include <cstddef>

#include "raytrace/cameras/view_plane.h"

namespace raytrace {

/// The part of a filter, along one axis, that lies within `part` of its half width about the middle: from 0 to 1.
double filter_share(PixelFilter filter, double part);

/// The inverse of filter_share(), as a table. Samples by blackman_harris stay within nine tenths of its width: what of
/// it lies beyond, 1.3e-4 of it, lies there as well.
class FilterTable {
 public:
  static constexpr std::size_t intervals = 1024;

  explicit FilterTable(const ViewPlane& viewplane);

  /// False for a box of a pixel's own width: samples stay where they are in the pixel's square.
  bool moves_samples() const { return moves_samples_; }

  /// How far samples lie from the middle at most, in pixels, along an axis.
  double reach() const { return moves_samples_ ? static_cast<double>(distances_.back()) : 0.5; }

  /// The share of samples that lie so many pixels from the middle along one axis, for each pixel there.
  double density(double distance) const;

  /// In pixels from the middle, where filter_share() is i / intervals; intervals + 1 of them.
  const float* distances() const { return distances_.data(); }

 private:
  bool moves_samples_;
  std::array<float, intervals + 1> distances_{};
};

}  // namespace raytrace
