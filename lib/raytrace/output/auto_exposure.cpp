#include "raytrace/output/auto_exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "raytrace/cameras/view_plane.h"
#include "raytrace/output/pixel_format.h"

namespace raytrace {

namespace {

// 2^28 pixels (film/region.h), each of a logarithm below 2^8: the sum stays below 2^62.
constexpr double weight_units = 1024, logarithm_units = 65536;

}  // namespace

void AutoExposure::add(const Pixel& pixel) {
  const double luminance =
      0.2126 * double{pixel.red} + 0.7152 * double{pixel.green} + 0.0722 * double{pixel.blue};  // Rec. 709
  if (!(pixel.alpha > 0) || !(luminance > 0) || !std::isfinite(luminance)) return;
  const double alpha = std::min(double{pixel.alpha}, 1.0);
  const auto weight = static_cast<std::int64_t>(std::nearbyint(alpha * weight_units));
  const double logarithm = std::clamp(std::log2(luminance / alpha / 0.18), -200.0, 200.0);
  logarithms_ += weight * static_cast<std::int64_t>(std::nearbyint(logarithm * logarithm_units));
  weights_ += weight;
}

void AutoExposure::add(const ImageBand& band) {
  for (std::size_t i = 0; i < band.region.pixels(); ++i) add(color_at(band, i));
}

double AutoExposure::stops() const {
  if (weights_ == 0) return 0;
  const double mean = static_cast<double>(logarithms_) / (static_cast<double>(weights_) * logarithm_units);
  const double hundredths = -std::nearbyint(std::clamp(mean, -largest_exposure, largest_exposure) * 100);
  return hundredths == 0 ? 0 : hundredths / 100;
}

double automatic_exposure(const Film& film) {
  AutoExposure exposure;
  const Region& region = film.region();
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) exposure.add(film.pixel(x, y));
  return exposure.stops();
}

}  // namespace raytrace
