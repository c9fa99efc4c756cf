#include "raytrace/sampling/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raytrace {

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
