#include "raytrace/tracing/render_tile.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "raytrace/sampling/pixel_sampler.h"
#include "raytrace/tracing/integrator_calls.h"
#include "raytrace/tracing/light_layers.h"
#include "raytrace/tracing/light_paths.h"
#include "raytrace/tracing/open_block.h"
#include "raytrace/tracing/packet_block.h"
#include "raytrace/tracing/samples_left.h"
#include "raytrace/tracing/shadow_catcher.h"
#include "raytrace/tracing/stage_times.h"

namespace raytrace {

namespace {

/// The stop flag is looked at every so many packets.
constexpr int packets_per_look = 16;

FloatN to_float(const UintN& numbers) { return to_float(same_bits<IntN>(numbers)); }
FloatN to_float(std::uint32_t number) { return FloatN(static_cast<float>(static_cast<std::int32_t>(number))); }

/// The pixels of a part of a film, block by block. Ray casting takes so little time that a call for each packet shows,
/// so it has renderers of its own; all other integrators share theirs.
template <bool raycast, PacketShape shape>
class BlockRenderer {
 public:
  BlockRenderer(const TracedScene& scene, const Region& region, Film& film, const std::atomic<bool>* stop)
      : scene_(scene),
        integrator_(calls_of(scene.tables())),
        region_(region),
        film_(film),
        stop_(stop),
        background_(film.settings().transparent ? Rgb<float>(0, 0, 0)
                                                : Rgb<float>(scene.tables().viewplane().background)),
        environment_(scene.tables().environment() != nullptr && scene.tables().environment()->visible() &&
                             !film.settings().transparent
                         ? scene.tables().environment()
                         : nullptr),
        scale_(film.settings().unit_exponent),
        group_(Block::slots(), shape.samples),
        scrambles_(film.settings().seed),
        usual_camera_(scene.tables().pixel_filter().moves_samples() ? nullptr : scene.tables().usual_camera()),
        layers_(light_layers(scene.tables(), film)),
        group_light_(layers_.size()),
        by_group_(layers_.size() > 1 || layers_.front() != nullptr),
        pass_layers_(pass_layers(film)),
        by_pass_(has_passes(film.settings().aovs.wanted)) {
    if (!raycast && integrator_.radiance == nullptr) batch_.emplace(scene, film);
    catches_shadows_ = film.settings().transparent && integrator_catches_shadows(scene.tables()) &&
                       scene.tables().geometry().has_shadow_catchers();
    needs_sample_ids_ = (!raycast && integrator_.takes_samples) || scene.tables().identifies_rays() ||
                        scene.tables().has_sampled_lights() || catches_shadows_;
    if (film.splats() != nullptr) light_paths_.emplace(scene, film, batch_->clock());
  }

  /// Continues all pixels to `samples` each; returns early if it is stopped.
  RenderReport render(std::uint32_t samples) {
    render_blocks(samples);
    if (batch_) trace_batch();
    if (light_paths_) light_paths_->finish(report_);
    if (open_) close_block();
    if (batch_) report_.stages += batch_->clock().times();
    return report_;
  }

 private:
  using Block = PacketBlock<shape>;

  void render_blocks(std::uint32_t samples) {
    for (int top = round_down(region_.y0, shape.height); top < region_.y1; top += shape.height)
      for (int left = round_down(region_.x0, shape.width); left < region_.x1; left += shape.width) {
        render({left, top}, samples);
        if (stopped()) return;
      }
  }

  void render(const Block& block, std::uint32_t samples) {
    const SamplesLeft<Block> left(film_, block, region_, samples);
    if (left.first >= left.last) return;
    if (film_.aovs() == nullptr) return render(block, left, nullptr);
    BlockAovs aovs(*film_.aovs(), block, region_);
    render(block, left, &aovs);
    aovs.finish();
  }

  void render(const Block& block, const SamplesLeft<Block>& left, BlockAovs* aovs) {
    const FilmSettings& settings = film_.settings();
    const ViewPlane& viewplane = scene_.tables().viewplane();
    const auto column = block.columns(), row = block.rows();
    const auto width = static_cast<float>(viewplane.hres), height = static_cast<float>(viewplane.vres);
    // The lower left corner of the pixel, from the picture's center; rows of the format count from the bottom.
    const FloatN x = to_float(column) - FloatN(width / 2);
    const FloatN y = FloatN(height / 2 - 1) - to_float(row);
    const MaskN active = in_view(to_float(column), to_float(row));

    // From the group that the first sample is in, with all that belong to it.
    constexpr std::uint32_t group{shape.samples};
    std::uint32_t base = left.first / group * group;
    PixelSampler sampler(scramble_of(block), group_, base, settings.samples.centered);
    BlockSums<Block> sums(scale_);
    std::optional<GroupSums<Block>> group_sums;
    if (by_group_) group_sums.emplace(scale_, layers_.size());
    std::optional<PassSums<Block>> pass_sums;
    if (by_pass_ && !batch_) pass_sums.emplace(scale_, pass_layers_);
    BlockError<Block> error(left.first, left.last);
    FirstHits first;
    CameraRays camera;
    for (int packets = 1; base < left.last; base += group, ++packets) {
      if (!raycast && batch_) batch_->clock().begin_packet();
      const UintN sample = UintN(base) + Block::slots();
      const bool all_wanted = base >= left.all_from && left.last - base >= group;
      const MaskN wanted = all_wanted ? active : active & in_range(sample, left.lane_first, UintN(left.last));
      const Sample2D point = sampler.next();
      if (needs_sample_ids_) [[unlikely]] {
        camera.pixel = pixel_hash(UintN(column), UintN(row), film_.settings().seed);
        camera.sample = sample;
      }
      if (catches_shadows_) [[unlikely]] {
        caught_.counted = wanted;
        camera.caught = &caught_;
      }
      MaskN traced = active;
      if (usual_camera_ != nullptr) [[likely]] {
        camera.rays = usual_camera_->template generate<FloatN>(x + point.x, y + point.y);
      } else {
        traced = active & set_camera_rays(block, FloatN(x), FloatN(y), Sample2D(point), UintN(sample), camera);
      }
      FirstHits* const first_hits = aovs != nullptr || by_pass_ ? &first : nullptr;
      RayResult result;
      if (!raycast && batch_)
        result = {Rgb<FloatN>(background_), batch_->add(camera, traced, wanted, first_hits)};
      else if (raycast && by_group_)
        result = {Rgb<FloatN>(background_), Kernel<Raycast>::radiance_by_group(scene_, camera, traced, wanted,
                                                                               report_.rays, first_hits, group_light_)};
      else
        result = raycast
                     ? Kernel<Raycast>::radiance(scene_, background_, camera, traced, wanted, report_.rays, first_hits)
                     : integrator_.radiance(scene_, background_, camera, traced, wanted, report_.rays, first_hits);
      if (catches_shadows_) [[unlikely]]
        caught_.add_to(result, group_light_, report_.rays);
      if (environment_ != nullptr) [[unlikely]]
        result.radiance = in_environment(*environment_, RayResult(result), Vec3<FloatN>(camera.rays.direction));
      if (usual_camera_ == nullptr) [[unlikely]]
        result.radiance = select(traced, result.radiance, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
      if (aovs != nullptr) [[unlikely]] {
        const auto* const textures = first.textures ? &*first.textures : nullptr;
        aovs->add(AovInputs(scene_.tables(), camera, first.hits, first.surface, textures), wanted, sample,
                  batch_ && batch_->follows_mirrors());
      }
      report_.rays.camera += count_lanes(wanted & traced);
      if (!raycast && batch_) batch_->clock().end(Stage::film);
      if (!raycast && light_paths_) {
        // They are in the film before the samples are, but in one call of render(): nobody looks at it in between.
        light_paths_->begin(block, region_, sample, wanted, report_);
        batch_->clock().end(Stage::light_paths);
      }
      if (!raycast && batch_) {
        waiting_.push_back({block, base, left.first, left.last, wanted, result});
        if (batch_->is_full()) trace_batch();
        if (packets % packets_per_look == 0 && stopped()) break;
        continue;
      }
      std::uint32_t refused = 0;  // lanes, as bits, whose light is no number that sums can hold
      if (by_group_) [[unlikely]] {
        if (!raycast) set_light_of_no_group(group_light_, result.radiance);
        refused = add_by_group(*group_sums, result, wanted, block, base);
        if (!raycast) error.add(light_of_all(group_light_), sample, wanted);
      } else {
        if (!raycast) error.add(result.radiance, sample, wanted);
        const MaskN large = sums.add(result, wanted);
        if (any(large)) refused = add_invalid(sums.add_large(result.radiance, large), block, base);
        if (packets % (sums.most_packets / packets_per_look * packets_per_look) == 0) sums.carry();
      }
      if (by_pass_) [[unlikely]]  // copies, as above
        pass_sums->add(light_of_passes(camera, first, RayResult(result), MaskN(wanted)), MaskN(wanted), refused);
      if (packets % packets_per_look == 0 && stopped()) break;
    }
    if (!raycast && batch_) return;
    if (pass_sums) pass_sums->add_to_layers(block, region_);
    if (by_group_)
      group_sums->add_to(film_, layers_, block, region_);
    else
      sums.add_to(film_, block, region_);
    if (!raycast) error.add_to(report_.error, block, region_);
  }

  /// Lanes whose light is their paths': in transparent pictures all, since fog lights what it does not cover.
  MaskN has_own_light(const MaskN& hit) const { return batch_ && film_.settings().transparent ? MaskN(true) : hit; }

  /// By passes, of integrators without a batch.
  [[gnu::noinline]] PassLight light_of_passes(const CameraRays& camera, const FirstHits& first, const RayResult& result,
                                              const MaskN& wanted) const {
    return raycast ? Kernel<Raycast>::passes(scene_, camera, first, result, wanted) : emitted_or_behind(result);
  }

  /// Adds group_light_ where something was hit. missed: its radiance is what arrives elsewhere. The result: the lanes,
  /// as bits, that are refused.
  std::uint32_t add_by_group(GroupSums<Block>& sums, const RayResult& missed, const MaskN& wanted, const Block& block,
                             std::uint32_t base) {
    const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
    const auto group = static_cast<std::size_t>(environment_ != nullptr ? scene_.tables().environment_group() : 0);
    for (std::size_t i = 0; i < group_light_.size(); ++i)
      group_light_[i] = select(has_own_light(missed.hit), group_light_[i], i == group ? missed.radiance : black);
    const std::uint32_t refused = sums.add(group_light_, missed.hit, wanted);
    return refused == 0 ? 0 : add_invalid(refused, block, base);
  }
  /// The passes of a packet whose paths have been traced.
  void add_passes(std::size_t packet, std::uint32_t refused) {
    if (!by_pass_) return;
    PassLight light = batch_->passes(packet);
    const RayResult& missed = waiting_[packet].missed;
    Rgb<FloatN>& background = light[static_cast<std::size_t>(LightPass::background)];
    background = select(has_own_light(missed.hit), background, missed.radiance);
    open_->pass_sums->add(light, waiting_[packet].wanted, refused);
  }

  /// Packets' results, when their paths have been traced.
  void trace_batch() {
    batch_->trace(report_.rays);
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      const WaitingPacket<Block>& packet = waiting_[i];
      batch_->clock().begin_packet();
      if (!open_ || open_->block.left != packet.block.left || open_->block.top != packet.block.top) {
        if (open_) close_block();
        open_ = std::make_unique<OpenBlock<Block>>(packet, scale_, layers_.size());
        if (by_pass_) open_->pass_sums.emplace(scale_, pass_layers_);
        if (batch_->follows_mirrors()) open_->followed.emplace(*film_.aovs(), packet.block, region_);
      }
      if (open_->followed) open_->followed->add_followed(batch_->followed(i), packet.wanted);
      const UintN sample = UintN(packet.base) + Block::slots();
      if (by_group_) {
        for (std::size_t group = 0; group < group_light_.size(); ++group)
          group_light_[group] = batch_->radiance(i, group);
        const std::uint32_t refused =
            add_by_group(open_->group_sums, packet.missed, packet.wanted, packet.block, packet.base);
        add_passes(i, refused);
        open_->error.add(light_of_all(group_light_), sample, packet.wanted);
        continue;
      }
      BlockSums<Block>& sums = open_->sums;
      const MaskN hit = packet.missed.hit;
      const RayResult result{select(has_own_light(hit), batch_->radiance(i, 0), packet.missed.radiance), hit};
      open_->error.add(result.radiance, sample, packet.wanted);
      const MaskN large = sums.add(result, packet.wanted);
      add_passes(i, any(large) ? add_invalid(sums.add_large(result.radiance, large), packet.block, packet.base) : 0);
      if (++open_->packets % sums.most_packets == 0) sums.carry();
      batch_->clock().end(Stage::film);
    }
    waiting_.clear();
    batch_->clear();
  }

  void close_block() {
    if (by_group_)
      open_->group_sums.add_to(film_, layers_, open_->block, region_);
    else
      open_->sums.add_to(film_, open_->block, region_);
    if (open_->pass_sums) open_->pass_sums->add_to_layers(open_->block, region_);
    open_->error.add_to(report_.error, open_->block, region_);
    if (open_->followed) open_->followed->finish();
    open_.reset();
  }

  /// Of any camera and pixel filter. Copies, as above.
  [[gnu::noinline]] MaskN set_camera_rays(const Block& block, const FloatN& x, const FloatN& y, const Sample2D& point,
                                          const UintN& sample, CameraRays& camera) const {
    const SceneTables& tables = scene_.tables();
    const Sample2D placed = tables.pixel_filter().moves_samples() ? filtered(tables.pixel_filter(), point) : point;
    Sample2D lens{FloatN(0), FloatN(0)};
    if (tables.camera_has_lens()) {
      const UintN pixel = pixel_hash(UintN(block.columns()), UintN(block.rows()), film_.settings().seed);
      lens = get_2d(pixel, sample, Dimension::lens);
    }
    return tables.set_camera_rays(x + placed.x, y + placed.y, lens, camera);
  }

  /// Pixels of the picture, and those beyond it that are wanted.
  MaskN in_view(const FloatN& column, const FloatN& row) const {
    const ViewPlane& viewplane = scene_.tables().viewplane();
    const Region& wanted = film_.region();
    const auto number = [](int edge) { return FloatN(static_cast<float>(edge)); };
    const MaskN inside =
        (column < number(std::max(viewplane.hres, wanted.x1))) & (row < number(std::max(viewplane.vres, wanted.y1)));
    if (wanted.x0 >= 0 && wanted.y0 >= 0) return inside;
    return inside & (column >= number(std::min(0, wanted.x0))) & (row >= number(std::min(0, wanted.y0)));
  }

  /// Of each lane's pixel.
  auto scramble_of(const Block& block) {
    const auto left = static_cast<std::uint32_t>(block.left), top = static_cast<std::uint32_t>(block.top);
    if constexpr (Block::pixels == 1) {
      return scrambles_.at(left, top);
    } else if constexpr (Block::pixels == 2) {
      const PixelScramble<std::uint32_t> even = scrambles_.at(left, top), odd = scrambles_.at(left + 1, top);
      return PixelScramble<UintN>(alternate(even.x, odd.x), alternate(even.y, odd.y));
    } else if (film_.settings().samples.centered) {
      return PixelScramble<UintN>(UintN(0u), UintN(0u));  // it shifts nothing
    } else {
      return PixelScramble<UintN>(block.columns(), block.rows(), film_.settings().seed);
    }
  }

  static MaskN in_range(const UintN& number, const UintN& first, const UintN& last) {
    return float_mask<FloatN>(same_bits<IntN>(number - first) >= IntN(0)) &
           float_mask<FloatN>(same_bits<IntN>(number - last) < IntN(0));
  }

  bool stopped() const { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }
  /// The result: those lanes, as bits.
  std::uint32_t add_invalid(std::uint32_t lanes, const Block& block, std::uint32_t base) {
    block.for_each_lane(region_, [&](int x, int y, std::size_t lane) {
      if ((lanes >> lane & 1U) != 0)
        report_.invalid_samples.add({x, y, base + static_cast<std::uint32_t>(Block::slot(static_cast<int>(lane)))});
    });
    return lanes;
  }

  const TracedScene& scene_;
  IntegratorCalls integrator_;
  const Region& region_;
  Film& film_;
  const std::atomic<bool>* stop_;
  Rgb<float> background_;           ///< what camera rays see where they meet nothing
  const Environment* environment_;  ///< if it is there in place of the background, else null
  SumScale scale_;
  SampleGroup group_;
  PixelScrambles scrambles_;
  decltype(std::declval<SceneTables>().usual_camera()) usual_camera_;  ///< if samples stay in their pixels
  RenderReport report_;
  bool catches_shadows_ = false, needs_sample_ids_ = false;  ///< the latter: of CameraRays, pixel and sample
  CaughtShadows caught_;                                     ///< of the packet at hand

  // Of light groups.
  std::vector<LightLayer*> layers_;
  std::vector<Rgb<FloatN>> group_light_;  ///< of the packet at hand
  bool by_group_;                         ///< whether the picture is put together of them

  PassLayers pass_layers_;
  bool by_pass_;  ///< whether the film has any
  // Of integrators with batches.
  std::optional<PathBatch> batch_;
  std::optional<LightPaths> light_paths_;      ///< where the scene has them
  std::vector<WaitingPacket<Block>> waiting_;  ///< the batch's, in its order
  std::unique_ptr<OpenBlock<Block>> open_;     ///< that of the last one that left
};

template <bool raycast>
RenderReport render_tile_by(const TracedScene& scene, const Region& region, std::uint32_t samples, Film& film,
                            const std::atomic<bool>* stop) {
  const auto in_groups_of = [&]<int group>(std::integral_constant<int, group>) {
    return BlockRenderer<raycast, shape_of_samples(group)>(scene, region, film, stop).render(samples);
  };
  // As many samples of as few pixels as there are samples at hand: such rays are closer together than those of one
  // sample of many pixels. Samples 0, 1, ... of a pixel belong to groups, and lanes may be left without work in the
  // first and the last of them.
  const std::uint32_t begin = film.settings().samples.first, last = begin + samples;
  std::uint32_t first = begin;
  if (film.content() == FilmContent::sums) first += film.sum(region.x1 - 1, region.y1 - 1).samples;  // none has fewer
  const auto few_are_idle = [&](std::uint64_t group) {
    const std::uint64_t wanted = last - first, lanes = (last + group - 1) / group * group - first / group * group;
    return lanes - wanted <= wanted / 8;
  };
  if (first < last) {
    if (film.aovs() == nullptr) {  // they take too much for each block: one should have several packets
      if (few_are_idle(packet_lanes)) return in_groups_of(std::integral_constant<int, packet_lanes>());
      if constexpr (raycast)
        if (few_are_idle(packet_lanes / 2)) return in_groups_of(std::integral_constant<int, packet_lanes / 2>());
      if constexpr (raycast && packet_lanes > 16)
        if (few_are_idle(packet_lanes / 4)) return in_groups_of(std::integral_constant<int, packet_lanes / 4>());
    }
    if (few_are_idle(4)) return in_groups_of(std::integral_constant<int, 4>());
  }
  return in_groups_of(std::integral_constant<int, 1>());
}

}  // namespace

RadianceRange radiance_range(const SceneTables& scene) {
  return with_type(Integrators{}, scene.integrator().index(), [&]<class Integrator>(std::type_identity<Integrator>) {
    return Kernel<Integrator>::radiance_range(scene);
  });
}

RenderReport render_tile(const TracedScene& scene, const Region& region, std::uint32_t samples, Film& film,
                         const std::atomic<bool>* stop) {
  return std::holds_alternative<Raycast::Parameters>(scene.tables().integrator())
             ? render_tile_by<true>(scene, region, samples, film, stop)
             : render_tile_by<false>(scene, region, samples, film, stop);
}

}  // namespace raytrace
