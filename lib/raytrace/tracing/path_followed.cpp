// What paths meet behind mirrors and glass, for AOVs.
#include <array>
#include <cstddef>

#include "raytrace/math/lanes.h"
#include "raytrace/tracing/path_batch.h"

namespace raytrace {

namespace {

/// Calls f(packet, lane, lane of the packet at hand) for each of those lanes' slots; of branches, for the first.
template <class Function>
void for_each_slot(const IntN& slot, std::size_t strands, const MaskN& lanes, const Function& f) {
  alignas(64) std::array<std::int32_t, packet_lanes> slots;
  slot.store_aligned(slots.data());
  for (const std::size_t lane : SetLanes(lanes)) {
    const auto to = static_cast<std::size_t>(slots[lane]);
    if (to / packet_lanes % strands > 1) continue;
    f(to / packet_lanes / strands, to % packet_lanes, lane);
  }
}

}  // namespace

void PathBatch::follow(const PathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                       const TexturePoint<FloatN>* point, const MaskN& lanes) {
  // What fog scatters shows nothing of where it goes.
  const MaskN scattered = lanes & float_mask<FloatN>(path.way == IntN(by_scattering));
  if (any(scattered)) stop_following(path, scattered);
  // What mirrors and glass let through: without the radiance's change by refraction. Roulette makes it larger than
  // that.
  const Rgb<FloatN> throughput = path.throughput * path.eta2;
  const Rgb<FloatN> through{min(throughput.red, FloatN(1)), min(throughput.green, FloatN(1)),
                            min(throughput.blue, FloatN(1))};
  const Rgb<FloatN> albedo = through * scene_.tables().albedo(hits, point);
  const Vec3<FloatN> normal = surface.base_normal();
  const FloatN values[] = {albedo.red, albedo.green, albedo.blue, normal.x, normal.y, normal.z};
  alignas(64) std::array<std::array<float, packet_lanes>, 6> stored;
  for (std::size_t i = 0; i < stored.size(); ++i) values[i].store_aligned(stored[i].data());
  for_each_slot(path.slot, strands_, lanes, [&](std::size_t packet, std::size_t to, std::size_t from) {
    Followed& followed = followed_[packet];
    if (followed.has_ended[to]) return;
    for (std::size_t i = 0; i < stored.size(); ++i) followed.values[i][to] = stored[i][from];
  });
}

void PathBatch::stop_following(const PathPacket& path, const MaskN& lanes) {
  for_each_slot(path.slot, strands_, lanes,
                [&](std::size_t packet, std::size_t to, std::size_t) { followed_[packet].has_ended[to] = true; });
}

FollowedSurface PathBatch::followed(std::size_t packet) const {
  const auto& values = followed_[packet].values;
  const auto load = [&](std::size_t i) { return FloatN::load_unaligned(values[i].data()); };
  return {{load(0), load(1), load(2)}, {load(3), load(4), load(5)}};
}

}  // namespace raytrace
