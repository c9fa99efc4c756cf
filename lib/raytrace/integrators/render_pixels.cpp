#include "raytrace/integrators/render_pixels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "raytrace/integrators/registry.h"
#include "raytrace/sampling/pixel_sampler.h"

namespace raytrace {

namespace {

/// Packets cover blocks of 4 x 4, 4 x 2 or 2 x 2 pixels: as square as they can be, for rays that stay together.
constexpr int block_width = native_lanes >= 8 ? 4 : 2;
constexpr int block_height = native_lanes / block_width;

/// Samples are summed in float in runs of this many, and the runs in double: no error grows with their number.
constexpr int samples_per_run = 16;

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

struct BlockSum {
  Doubles<FloatN> red{0.0}, green{0.0}, blue{0.0}, hits{0.0};
};

/// The mean of a block's samples, to the pixels that the region holds.
void write_block(const BlockSum& sum, int samples, int left, int top, const Region& region, Film& film) {
  const Doubles<FloatN> count(static_cast<double>(samples));
  alignas(64) std::array<std::array<float, native_lanes>, 4> mean;
  (sum.red / count).to_float().store_aligned(mean[0].data());
  (sum.green / count).to_float().store_aligned(mean[1].data());
  (sum.blue / count).to_float().store_aligned(mean[2].data());
  (sum.hits / count).to_float().store_aligned(mean[3].data());
  for (int row = std::max(top, region.y0); row < std::min(top + block_height, region.y1); ++row)
    for (int column = std::max(left, region.x0); column < std::min(left + block_width, region.x1); ++column) {
      const auto lane = static_cast<std::size_t>((row - top) * block_width + column - left);
      film.at(column, row) = {mean[0][lane], mean[1][lane], mean[2][lane], mean[3][lane]};
    }
}

/// Nothing if `stop` was set before the last sample.
template <class Integrator>
std::optional<BlockSum> render_block(const TracedScene& scene, int left, int top, std::uint64_t seed,
                                     const std::atomic<bool>* stop, RayCounts& counts) {
  const ViewPlane& viewplane = scene.viewplane();
  const UintN column = UintN(static_cast<std::uint32_t>(left)) + UintN::load_aligned(lane_numbers.column.data());
  const UintN row = UintN(static_cast<std::uint32_t>(top)) + UintN::load_aligned(lane_numbers.row.data());
  const auto width = static_cast<float>(viewplane.hres), height = static_cast<float>(viewplane.vres);
  // The lower left corner of the pixel, from the picture's center; rows of the format count from the bottom.
  const FloatN x = to_float(column) - FloatN(width / 2);
  const FloatN y = FloatN(height / 2 - 1) - to_float(row);
  const MaskN active = (to_float(column) < FloatN(width)) & (to_float(row) < FloatN(height));
  const auto active_count = static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(active)));

  PixelSampler sampler(column, row, seed, viewplane.samples);
  BlockSum sum;
  for (int first = 0; first < viewplane.samples; first += samples_per_run) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return std::nullopt;
    const int last = std::min(first + samples_per_run, viewplane.samples);
    Rgb<FloatN> run{Rgb<float>(0, 0, 0)};
    FloatN hits(0);
    for (int sample = first; sample < last; ++sample) {
      const PixelSampler::Point point = sampler.next();
      const Ray<FloatN> rays = scene.camera().generate(x + point.x, y + point.y);
      const SeenRadiance seen = Integrator::radiance(scene, rays, active, counts);
      run += seen.radiance;
      hits = hits + xsimd::select(seen.hit, FloatN(1), FloatN(0));
    }
    counts.camera += active_count * static_cast<std::uint64_t>(last - first);
    sum.red += run.red;
    sum.green += run.green;
    sum.blue += run.blue;
    sum.hits += hits;
  }
  return sum;
}

}  // namespace

RayCounts render_pixels(const TracedScene& scene, const Region& region, std::uint64_t seed, Film& film,
                        const std::atomic<bool>* stop) {
  RayCounts counts;
  for (int top = region.y0 / block_height * block_height; top < region.y1; top += block_height)
    for (int left = region.x0 / block_width * block_width; left < region.x1; left += block_width) {
      const std::optional<BlockSum> sum = render_block<Raycast>(scene, left, top, seed, stop, counts);
      if (!sum) return counts;
      write_block(*sum, scene.viewplane().samples, left, top, region, film);
    }
  return counts;
}

}  // namespace raytrace
