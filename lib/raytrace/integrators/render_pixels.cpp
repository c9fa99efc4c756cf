#include "raytrace/integrators/render_pixels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "raytrace/integrators/block_aovs.h"
#include "raytrace/integrators/packet_block.h"
#include "raytrace/integrators/registry.h"
#include "raytrace/math/fixed_point_sums.h"
#include "raytrace/sampling/pixel_sampler.h"

namespace raytrace {

namespace {

/// The stop flag is looked at every so many packets.
constexpr int packets_per_look = 16;

FloatN to_float(const UintN& numbers) { return xsimd::to_float(std::bit_cast<IntN>(numbers)); }

/// The sums of a block's samples, lane by lane.
class BlockSums {
 public:
  explicit BlockSums(int unit_exponent)
      : units_(std::ldexp(1.0, -unit_exponent)),
        most_(static_cast<float>(std::min(std::ldexp(FixedPointSums<FloatN>::largest_term, unit_exponent),
                                          static_cast<double>(std::numeric_limits<float>::max())))) {}

  /// Adds a sample of each lane of `wanted`. The result: those whose radiance is not finite (or beyond what the sums
  /// can hold), which are counted as black.
  MaskN add(const SeenRadiance& seen, const MaskN& wanted) {
    // Radiances are not negative: the sum is large where one of them is, and NaN compares false.
    const MaskN fine = wanted & (seen.radiance.red + seen.radiance.green + seen.radiance.blue <= most_);
    const Rgb<FloatN> radiance = select(fine, seen.radiance, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
    red_.add(radiance.red, units_);
    green_.add(radiance.green, units_);
    blue_.add(radiance.blue, units_);
    hits_ = hits_ + select_lanes(seen.hit & wanted, IntN(1), IntN(0));
    samples_ = samples_ + select_lanes(wanted, IntN(1), IntN(0));
    return wanted & !fine;
  }

  /// Adds them to the pixels of the block that lie in the region.
  template <class Block>
  void add_to(Film& film, const Block& block, const Region& region) const {
    const auto red = red_.sums(), green = green_.sums(), blue = blue_.sums();
    alignas(64) std::array<std::int32_t, native_lanes> hits, samples;
    hits_.store_aligned(hits.data());
    samples_.store_aligned(samples.data());
    block.for_each_lane(region, [&](int x, int y, std::size_t lane) {
      film.sum(x, y) += {red[lane], green[lane], blue[lane], static_cast<std::uint32_t>(hits[lane]),
                         static_cast<std::uint32_t>(samples[lane])};
    });
  }

 private:
  Doubles<FloatN> units_;
  FloatN most_;
  FixedPointSums<FloatN> red_, green_, blue_;
  IntN hits_ = IntN(0), samples_ = IntN(0);
};

/// The pixels of a part of a film, block by block.
template <class Integrator, PacketShape shape>
class BlockRenderer {
 public:
  BlockRenderer(const TracedScene& scene, const Region& region, Film& film, const std::atomic<bool>* stop)
      : scene_(scene), region_(region), film_(film), stop_(stop) {}

  /// Continues all pixels to `samples` each; returns early if it is stopped.
  RenderReport render(std::uint32_t samples) {
    for (int top = region_.y0 / shape.height * shape.height; top < region_.y1; top += shape.height)
      for (int left = region_.x0 / shape.width * shape.width; left < region_.x1; left += shape.width) {
        render({left, top}, samples);
        if (stopped()) return report_;
      }
    return report_;
  }

 private:
  using Block = PacketBlock<shape>;

  void render(const Block& block, std::uint32_t samples) {
    const FilmSettings& settings = film_.settings();
    // All pixels of a block have as many: they are always rendered together.
    const std::uint32_t before = film_.sum(std::max(block.left, region_.x0), std::max(block.top, region_.y0)).samples;
    if (before >= samples) return;
    const std::uint32_t first = settings.samples.first + before, last = settings.samples.first + samples;

    const ViewPlane& viewplane = scene_.viewplane();
    const UintN column = block.columns(), row = block.rows(), slot = Block::slots();
    const auto width = static_cast<float>(viewplane.hres), height = static_cast<float>(viewplane.vres);
    // The lower left corner of the pixel, from the picture's center; rows of the format count from the bottom.
    const FloatN x = to_float(column) - FloatN(width / 2);
    const FloatN y = FloatN(height / 2 - 1) - to_float(row);
    const MaskN active = (to_float(column) < FloatN(width)) & (to_float(row) < FloatN(height));

    // From the group that the first sample is in, with all that belong to it.
    constexpr auto group = static_cast<std::uint32_t>(shape.samples);
    std::uint32_t base = first / group * group;
    PixelSampler sampler(column, row, slot, shape.samples, settings.seed, base, settings.samples.centered);
    BlockSums sums(settings.unit_exponent);
    std::optional<BlockAovs> aovs;
    if (film_.aovs() != nullptr) aovs.emplace(*film_.aovs(), block, region_);
    MetSurface met;
    for (int packets = 1; base < last; base += group, ++packets) {
      const UintN sample = UintN(base) + slot;
      const bool all_wanted = base >= first && last - base >= group;
      const MaskN wanted = all_wanted ? active : active & in_range(sample, first, last);
      const PixelSampler::Point point = sampler.next();
      const Ray<FloatN> rays = scene_.camera().generate(x + point.x, y + point.y);
      const SeenRadiance seen = Integrator::radiance(scene_, rays, active, wanted, report_.rays, aovs ? &met : nullptr);
      const MaskN bad = sums.add(seen, wanted);
      if (aovs) aovs->add(SeenSurface(scene_, rays, met.hits, met.point), wanted, sample);
      report_.rays.camera += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(wanted)));
      if (xsimd::any(bad)) set_aside(bad, block, base);
      if (packets % packets_per_look == 0 && stopped()) break;
    }
    sums.add_to(film_, block, region_);
    if (aovs) aovs->finish();
  }

  static MaskN in_range(const UintN& number, std::uint32_t first, std::uint32_t last) {
    return float_mask<FloatN>(std::bit_cast<IntN>(number - UintN(first)) >= IntN(0)) &
           float_mask<FloatN>(std::bit_cast<IntN>(number - UintN(last)) < IntN(0));
  }

  bool stopped() const { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }

  void set_aside(const MaskN& bad, const Block& block, std::uint32_t base) {
    const std::uint32_t lanes = bits_of<FloatN>(bad);
    block.for_each_lane(region_, [&](int x, int y, std::size_t lane) {
      if ((lanes >> lane & 1U) != 0)
        report_.set_aside.add({x, y, base + static_cast<std::uint32_t>(Block::slot(static_cast<int>(lane)))});
    });
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
  if (film.settings().samples.centered)
    return BlockRenderer<Raycast, centered_shape>(scene, region, film, stop).render(samples);
  return BlockRenderer<Raycast, sampled_shape>(scene, region, film, stop).render(samples);
}

}  // namespace raytrace
