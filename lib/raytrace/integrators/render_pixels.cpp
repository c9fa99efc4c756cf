#include "raytrace/integrators/render_pixels.h"

#include <algorithm>
#include <bit>

#include "raytrace/integrators/block_aovs.h"
#include "raytrace/integrators/block_sums.h"
#include "raytrace/integrators/packet_block.h"
#include "raytrace/integrators/registry.h"
#include "raytrace/sampling/pixel_sampler.h"

namespace raytrace {

namespace {

/// The stop flag is looked at every so many packets.
constexpr int packets_per_look = 16;

FloatN to_float(const UintN& numbers) { return to_float(same_bits<IntN>(numbers)); }

/// The pixels of a part of a film, block by block.
template <class Integrator, PacketShape shape>
class BlockRenderer {
 public:
  BlockRenderer(const TracedScene& scene, const Region& region, Film& film, const std::atomic<bool>* stop)
      : scene_(scene), region_(region), film_(film), stop_(stop), scale_(film.settings().unit_exponent) {}

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
    if (film_.aovs() == nullptr) return render(block, first, last, nullptr);
    BlockAovs aovs(*film_.aovs(), block, region_);
    render(block, first, last, &aovs);
    aovs.finish();
  }

  /// Samples [first, last) of the pixels' sequences.
  void render(const Block& block, std::uint32_t first, std::uint32_t last, BlockAovs* aovs) {
    const FilmSettings& settings = film_.settings();
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
    BlockSums sums(scale_);
    MetSurface met;
    for (int packets = 1; base < last; base += group, ++packets) {
      const UintN sample = UintN(base) + slot;
      const bool all_wanted = base >= first && last - base >= group;
      const MaskN wanted = all_wanted ? active : active & in_range(sample, first, last);
      const PixelSampler::Point point = sampler.next();
      const Ray<FloatN> rays = scene_.camera().generate(x + point.x, y + point.y);
      const SeenRadiance seen =
          Integrator::radiance(scene_, rays, active, wanted, report_.rays, aovs != nullptr ? &met : nullptr);
      const MaskN bad = sums.add(seen, wanted);
      if (aovs != nullptr) aovs->add(SeenSurface(scene_, rays, met.hits, met.point), wanted, sample);
      report_.rays.camera += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(wanted)));
      if (any(bad)) set_aside(bad, block, base);
      if (packets % packets_per_look == 0 && stopped()) break;
    }
    sums.add_to(film_, block, region_);
  }

  static MaskN in_range(const UintN& number, std::uint32_t first, std::uint32_t last) {
    return float_mask<FloatN>(same_bits<IntN>(number - UintN(first)) >= IntN(0)) &
           float_mask<FloatN>(same_bits<IntN>(number - UintN(last)) < IntN(0));
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
  BlockSums::Scale scale_;
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
