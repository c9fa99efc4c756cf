#include "picture_settings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "raytrace/film/tiles.h"

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
  if (!is_allowed_size(width, height)) {
    throw UsageError("a picture of " + size_text(width, height) + " pixels is too large; the most is " +
                     std::to_string(largest_edge) + " along an edge and " +
                     std::to_string(static_cast<long long>(most_pixels)) + " in all");
  }
  ViewPlane asked = viewplane;
  if (width != viewplane.hres || height != viewplane.vres) {
    asked = with_resolution(viewplane, static_cast<int>(width), static_cast<int>(height));
  }
  asked.samples = options.samples.value_or(viewplane.samples);
  if (std::int64_t{options.sample_offset.value_or(0)} + asked.samples > std::numeric_limits<int>::max()) {
    throw UsageError("--sample-offset: a picture has at most 2147483647 samples a pixel");
  }
  return asked;
}

SampleRange sample_range(const ViewPlane& viewplane, const Options& options) {
  const auto count = static_cast<std::uint32_t>(viewplane.samples);
  if (options.sample_offset) return {*options.sample_offset, count, false};
  return {0, count, count == 1};
}

Region crop_window(const ViewPlane& viewplane, const Options& options) {
  if (!options.crop) return {0, 0, viewplane.hres, viewplane.vres};
  if (const auto problem = crop_problem(*options.crop, viewplane.hres, viewplane.vres))
    throw UsageError("--crop: " + text_of(*options.crop) + ": " + *problem);
  return *options.crop;
}

Region render_window(const Region& whole, const Options& options) {
  if (options.pixel) {
    const auto [x, y] = *options.pixel;
    if (x < whole.x0 || y < whole.y0 || x >= whole.x1 || y >= whole.y1) {
      throw UsageError("--pixel: there is no pixel " + std::to_string(x) + "," + std::to_string(y) +
                       " in the picture of " + size_text(whole.width(), whole.height()) + " pixels" +
                       (options.crop ? ", " + text_of(whole) : ""));
    }
    return {x, y, x + 1, y + 1};
  }
  if (!options.tile) return whole;
  const auto pixels = std::int64_t{whole.width()} * whole.height();
  if (options.tile->count > pixels) {
    throw UsageError("--tile: the picture has only " + std::to_string(pixels) + " pixels");
  }
  return tile_of(whole, options.tile->index, options.tile->count);
}

}  // namespace raytrace
