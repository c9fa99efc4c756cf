#include "raytrace/sampling/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raytrace {

namespace {

/// The mean square of the parts at which the filter lies that are not within `least`.
double mean_square_beyond(PixelFilter filter, double least) {
  constexpr int steps = 4096;
  double sum = 0, below = filter_share(filter, least);
  const double all = 1 - below;
  for (int i = 1; i <= steps; ++i) {
    const double step = (1 - least) / steps, part = least + step * (i - 0.5);
    const double above = filter_share(filter, least + step * i);
    sum += part * part * (above - below);
    below = above;
  }
  return sum / all;
}

}  // namespace

double filter_share(PixelFilter filter, double part) {
  using std::numbers::pi;
  switch (filter) {
    case PixelFilter::triangle:
      return part * (2 - part);
    case PixelFilter::gaussian: {
      constexpr double edge = 3;  // standard deviations
      return std::erf(part * edge / std::numbers::sqrt2) / std::erf(edge / std::numbers::sqrt2);
    }
    case PixelFilter::blackman_harris:
      return part + (0.48829 * std::sin(pi * part) + 0.14128 / 2 * std::sin(2 * pi * part) +
                     0.01168 / 3 * std::sin(3 * pi * part)) /
                        (0.35875 * pi);
    case PixelFilter::box:
      break;
  }
  return part;
}

FilterTable::FilterTable(const ViewPlane& viewplane)
    : moves_samples_(viewplane.filter != PixelFilter::box || filter_width(viewplane) != 1) {
  if (!moves_samples_) return;
  double least = 0;
  for (std::size_t i = 0; i <= intervals; ++i) {
    const double share = static_cast<double>(i) / intervals;
    double low = least, high = 1;
    for (int step = 0; step < 40; ++step) {
      const double middle = (low + high) / 2;
      (filter_share(viewplane.filter, middle) < share ? low : high) = middle;
    }
    least = low;
    distances_[i] = static_cast<float>((i == 0 ? 0 : high) * filter_width(viewplane) / 2);
    // This one's end is so thin that a straight line to it would be too wide: it stops where its mean square is right.
    if (i + 1 == intervals && viewplane.filter == PixelFilter::blackman_harris) {
      const double square = 3 * mean_square_beyond(viewplane.filter, high);
      const double last = (std::sqrt(4 * square - 3 * high * high) - high) / 2;
      distances_[intervals] = static_cast<float>(last * filter_width(viewplane) / 2);
      return;
    }
  }
}

double FilterTable::density(double distance) const {
  const double size = std::abs(distance);
  if (!moves_samples_) return size <= 0.5 ? 1 : 0;
  const auto above = std::upper_bound(distances_.begin(), distances_.end(), size,
                                      [](double d, float step) { return d < static_cast<double>(step); });
  if (above == distances_.begin() || above == distances_.end()) return 0;
  return 0.5 / intervals / (static_cast<double>(*above) - static_cast<double>(*(above - 1)));
}

}  // namespace raytrace
