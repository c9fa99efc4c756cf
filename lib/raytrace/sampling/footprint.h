// The pixels of a row or column that a point of the film counts for, by the pixel filter.
#pragma once

#include <cmath>
#include <optional>

#include "raytrace/sampling/pixel_filter.h"

namespace raytrace {

class Footprint {
 public:
  /// at: the point, in pixels from the picture's edge. chance: from 0 to 1: all that it counts for is one pixel, which
  /// has that chance of the filter's share; none: each has its share.
  Footprint(const FilterTable& filter, double at, const std::optional<double>& chance) : filter_(filter), at_(at) {
    if (!filter.moves_samples()) {
      first_ = last_ = static_cast<int>(std::floor(at));
      return;
    }
    first_ = static_cast<int>(std::ceil(at - filter.reach() - 0.5));
    last_ = static_cast<int>(std::floor(at + filter.reach() - 0.5));
    if (!chance) return;
    double all = 0;
    for (int pixel = first_; pixel <= last_; ++pixel) all += density(pixel);
    double left = *chance * all;
    int pixel = first_;
    while (pixel < last_ && left >= density(pixel)) left -= density(pixel++);
    first_ = last_ = pixel;
    is_chosen_ = true;
    share_ = all;
  }

  int first() const { return first_; }
  int last() const { return last_; }
  double share(int pixel) const {
    if (is_chosen_) return share_;
    return filter_.moves_samples() ? density(pixel) : 1;
  }

 private:
  double density(int pixel) const { return filter_.density(at_ - pixel - 0.5); }

  const FilterTable& filter_;
  double at_;
  int first_ = 0, last_ = 0;
  bool is_chosen_ = false;
  double share_ = 0;  ///< the chosen one's
};

}  // namespace raytrace
