#include "picture_settings.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace raytrace {

namespace {

std::string size_text(double width, double height) {
  char text[64];
  std::snprintf(text, sizeof text, "%.0f x %.0f", width, height);
  return text;
}

}  // namespace

ViewPlane asked_viewplane(const ViewPlane& viewplane, const Options& options) {
  const Resolution unscaled = options.resolution.value_or(Resolution{viewplane.hres, viewplane.vres});
  const double width = std::max(1.0, std::round(unscaled.width * options.scale));
  const double height = std::max(1.0, std::round(unscaled.height * options.scale));
  if (width > largest_edge || height > largest_edge || width * height > most_pixels) {
    throw UsageError("a picture of " + size_text(width, height) + " pixels is too large; the most is " +
                     std::to_string(largest_edge) + " along an edge and " +
                     std::to_string(static_cast<long long>(most_pixels)) + " in all");
  }
  ViewPlane asked = viewplane;
  if (width != viewplane.hres || height != viewplane.vres) {
    asked = with_resolution(viewplane, static_cast<int>(width), static_cast<int>(height));
  }
  asked.samples = options.samples.value_or(viewplane.samples);
  return asked;
}

Region asked_region(const ViewPlane& viewplane, const Options& options) {
  if (!options.crop) return {0, 0, viewplane.hres, viewplane.vres};
  const Region& crop = *options.crop;
  if (crop.x0 < 0 || crop.y0 < 0 || crop.x1 > viewplane.hres || crop.y1 > viewplane.vres) {
    throw UsageError("--crop: the crop reaches outside the picture of " + size_text(viewplane.hres, viewplane.vres) +
                     " pixels");
  }
  return crop;
}

}  // namespace raytrace
