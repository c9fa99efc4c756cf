#include "raytrace/integrators/render_pixels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "raytrace/integrators/registry.h"
#include "raytrace/math/fixed_point_sums.h"
#include "raytrace/sampling/pixel_sampler.h"

namespace raytrace {

namespace {

/// Packets cover blocks of 4 x 4, 4 x 2 or 2 x 2 pixels: as square as they can be, for rays that stay together.
constexpr int block_width = native_lanes >= 8 ? 4 : 2;
constexpr int block_height = native_lanes / block_width;

/// The stop flag is looked at every so many samples.
constexpr std::uint32_t samples_per_look = 16;

struct LaneNumbers {
  alignas(64) std::array<std::uint32_t, native_lanes> column{}, row{};
};
constexpr LaneNumbers lane_numbers = [] {
  LaneNumbers lanes;
  for (unsigned lane = 0; lane < native_lanes; ++lane) {
    lanes.column[lane] = lane % block_width;
    lanes.row[lane] = lane / block_width;
  }
  return lanes;
}();

FloatN to_float(const UintN& numbers) { return xsimd::to_float(std::bit_cast<IntN>(numbers)); }

/// The sums of a block's samples, a pixel a lane.
class BlockSums {
 public:
  explicit BlockSums(int unit_exponent)
      : units_(std::ldexp(1.0, -unit_exponent)),
        most_(static_cast<float>(std::min(std::ldexp(FixedPointSums<FloatN>::largest_term, unit_exponent),
                                          static_cast<double>(std::numeric_limits<float>::max())))) {}

  /// Adds a sample of each pixel of `active`. The result: those whose radiance is not finite (or beyond what the sums
  /// can hold), which are counted as black.
  MaskN add(const SeenRadiance& seen, const MaskN& active) {
    Rgb<FloatN> radiance = seen.radiance;
    // Radiances are not negative: the sum is large where one of them is, and NaN compares false.
    const MaskN bad = active & !(radiance.red + radiance.green + radiance.blue <= most_);
    if (xsimd::any(bad)) radiance = select(bad, Rgb<FloatN>(Rgb<float>(0, 0, 0)), radiance);
    red_.add(radiance.red, units_);
    green_.add(radiance.green, units_);
    blue_.add(radiance.blue, units_);
    hits_ = hits_ + select_lanes(seen.hit, IntN(1), IntN(0));
    ++samples_;
    return bad;
  }

  std::uint32_t samples() const { return samples_; }

  /// Adds them to the pixels of the block at (left, top) that lie in the region.
  void add_to(Film& film, int left, int top, const Region& region) const {
    const auto red = red_.sums(), green = green_.sums(), blue = blue_.sums();
    alignas(64) std::array<std::int32_t, native_lanes> hits;
    hits_.store_aligned(hits.data());
    for (int row = std::max(top, region.y0); row < std::min(top + block_height, region.y1); ++row)
      for (int column = std::max(left, region.x0); column < std::min(left + block_width, region.x1); ++column) {
        const auto lane = static_cast<std::size_t>((row - top) * block_width + column - left);
        film.sum(column, row) += {red[lane], green[lane], blue[lane], static_cast<std::uint32_t>(hits[lane]), samples_};
      }
  }

 private:
  Doubles<FloatN> units_;
  FloatN most_;
  FixedPointSums<FloatN> red_, green_, blue_;
  IntN hits_ = IntN(0);
  std::uint32_t samples_ = 0;
};

/// Block by block, the pixels of a film's region, with what all blocks share.
template <class Integrator>
class BlockRenderer {
 public:
  BlockRenderer(const TracedScene& scene, const Region& region, Film& film, const std::atomic<bool>* stop)
      : scene_(scene), region_(region), film_(film), stop_(stop) {}

  /// Continues the block's pixels to `samples` each; false if it was stopped before.
  bool render(int left, int top, std::uint32_t samples) {
    const UintN column = UintN(static_cast<std::uint32_t>(left)) + UintN::load_aligned(lane_numbers.column.data());
    const UintN row = UintN(static_cast<std::uint32_t>(top)) + UintN::load_aligned(lane_numbers.row.data());
    const ViewPlane& viewplane = scene_.viewplane();
    const auto width = static_cast<float>(viewplane.hres), height = static_cast<float>(viewplane.vres);
    // The lower left corner of the pixel, from the picture's center; rows of the format count from the bottom.
    const FloatN x = to_float(column) - FloatN(width / 2);
    const FloatN y = FloatN(height / 2 - 1) - to_float(row);
    const MaskN active = (to_float(column) < FloatN(width)) & (to_float(row) < FloatN(height));

    const FilmSettings& settings = film_.settings();
    // All pixels of a block have as many: they are always rendered together.
    const std::uint32_t before = film_.sum(std::max(left, region_.x0), std::max(top, region_.y0)).samples;
    if (before >= samples) return true;
    const std::uint32_t missing = samples - before;
    PixelSampler sampler(column, row, settings.seed, settings.samples.first + before, settings.samples.centered);
    BlockSums sums(settings.unit_exponent);
    while (sums.samples() < missing && !stopped()) {
      const std::uint32_t pause = sums.samples() + std::min(samples_per_look, missing - sums.samples());
      while (sums.samples() < pause) {
        const PixelSampler::Point point = sampler.next();
        const Ray<FloatN> rays = scene_.camera().generate(x + point.x, y + point.y);
        const MaskN bad = sums.add(Integrator::radiance(scene_, rays, active, report_.rays), active);
        if (xsimd::any(bad)) set_aside(bad, left, top, settings.samples.first + before + sums.samples() - 1);
      }
    }
    sums.add_to(film_, left, top, region_);
    report_.rays.camera += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(active))) * sums.samples();
    return sums.samples() == missing;
  }

  const RenderReport& report() const { return report_; }

 private:
  bool stopped() const { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }

  void set_aside(const MaskN& bad, int left, int top, std::uint32_t sample) {
    for (std::uint32_t lanes = bits_of<FloatN>(bad); lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      const int x = left + lane % block_width, y = top + lane / block_width;
      if (x >= region_.x0 && x < region_.x1 && y >= region_.y0 && y < region_.y1) report_.set_aside.add({x, y, sample});
    }
  }

  const TracedScene& scene_;
  const Region& region_;
  Film& film_;
  const std::atomic<bool>* stop_;
  RenderReport report_;
};

}  // namespace

RenderReport render_pixels(const TracedScene& scene, const Region& region, std::uint32_t samples, Film& film,
                           const std::atomic<bool>* stop) {
  BlockRenderer<Raycast> renderer(scene, region, film, stop);
  for (int top = region.y0 / block_height * block_height; top < region.y1; top += block_height)
    for (int left = region.x0 / block_width * block_width; left < region.x1; left += block_width)
      if (!renderer.render(left, top, samples)) return renderer.report();
  return renderer.report();
}

}  // namespace raytrace
