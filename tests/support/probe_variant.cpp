#include <algorithm>
#include <array>

#include "raytrace/accel/accelerator.h"
#include "raytrace/accel/surface_uv.h"
#include "support/probe_backend.h"

namespace raytrace::test {

namespace {

using Lanes = std::array<float, packet_lanes>;

Vec3f lane_of(const Vec3<FloatN>& v, std::size_t lane) { return {v.x.get(lane), v.y.get(lane), v.z.get(lane)}; }

/// Calls f(first, count, rays, active) for each packet of the rays, which it may change.
template <class Function>
void for_each_packet(std::span<const ProbeRay> all, Function f) {
  constexpr std::size_t size = packet_lanes;
  for (std::size_t first = 0; first < all.size(); first += size) {
    const std::size_t count = std::min(size, all.size() - first);
    alignas(64) std::array<Lanes, 8> lanes{};
    for (std::size_t i = 0; i < count; ++i) {
      const ProbeRay& ray = all[first + i];
      const std::array<float, 8> values{ray.origin.x,    ray.origin.y,    ray.origin.z, ray.direction.x,
                                        ray.direction.y, ray.direction.z, ray.near,     ray.far};
      for (std::size_t field = 0; field < 8; ++field) lanes[field][i] = values[field];
    }
    const auto field = [&](std::size_t i) { return FloatN::load_aligned(lanes[i].data()); };
    Ray<FloatN> rays{{field(0), field(1), field(2)}, {field(3), field(4), field(5)}, field(6), field(7)};
    f(first, count, rays, first_lanes<FloatN>(static_cast<int>(count)));
  }
}

template <int size>
class EmbreePackets {
 public:
  using Packet = embree::Packet<size>;

  static std::vector<ProbeHit> intersect(RTCScene scene, std::span<const ProbeRay> rays) {
    std::vector<ProbeHit> result(rays.size());
    embree::Query query(true);
    for (std::size_t first = 0; first < rays.size(); first += size) {
      alignas(64) typename Packet::RayHit packet{};
      alignas(64) std::array<int, size> valid{};
      for (std::size_t i = 0; i < size; ++i) packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      load(rays, first, packet.ray, valid, query);
      Packet::intersect(valid.data(), scene, query, packet);
      for (std::size_t i = 0; i < size && first + i < rays.size(); ++i)
        if (query.geometry[i] != embree::Query::none) {
          ProbeHit& hit = result[first + i];
          hit.hit = true;
          hit.distance = query.distance[i];
          hit.kind = query.geometry[i];
          hit.index = query.primitive[i];
        }
    }
    return result;
  }

  static std::vector<bool> occluded(RTCScene scene, std::span<const ProbeRay> rays) {
    std::vector<bool> result(rays.size());
    embree::Query query(true);
    for (std::size_t first = 0; first < rays.size(); first += size) {
      alignas(64) typename Packet::Ray packet{};
      alignas(64) std::array<int, size> valid{};
      load(rays, first, packet, valid, query);
      Packet::occluded(valid.data(), scene, query, packet);
      for (std::size_t i = 0; i < size && first + i < rays.size(); ++i) result[first + i] = packet.tfar[i] < 0;
    }
    return result;
  }

 private:
  template <class Rays>
  static void load(std::span<const ProbeRay> all, std::size_t first, Rays& packet, std::array<int, size>& valid,
                   embree::Query& query) {
    for (std::size_t i = 0; i < size && first + i < all.size(); ++i) {
      const ProbeRay& ray = all[first + i];
      packet.org_x[i] = ray.origin.x;
      packet.org_y[i] = ray.origin.y;
      packet.org_z[i] = ray.origin.z;
      packet.dir_x[i] = ray.direction.x;
      packet.dir_y[i] = ray.direction.y;
      packet.dir_z[i] = ray.direction.z;
      packet.tnear[i] = ray.near;
      packet.tfar[i] = ray.far;
      packet.mask[i] = 0xffffffffu;
      packet.id[i] = static_cast<unsigned>(i);
      query.start(static_cast<unsigned>(i), ray.far);
      valid[i] = -1;
    }
  }
};

class Backend final : public ProbeBackend {
 public:
  explicit Backend(const SceneDescription& description)
      : tables_(description, 1, texture_point),
        accelerator_(tables_.geometry(), 1, embree_isa, tables_.fogs()),
        embree_alone_(tables_.geometry(), 1, embree_isa, tables_.fogs()) {
    embree_alone_.use_embree_alone();
  }

  std::vector<ProbeHit> intersect(std::span<const ProbeRay> all, ProbeWay way) const override {
    return intersect(all, way, nullptr);
  }

  std::vector<bool> occluded(std::span<const ProbeRay> all, ProbeWay way) const override {
    return occluded(all, way, nullptr);
  }

  std::optional<std::vector<ProbeHit>> intersect_seen_from(const Vec3f& point,
                                                           std::span<const ProbeRay> all) const override {
    const auto seen = seen_from({point});
    if (!seen) return std::nullopt;
    return intersect(all, ProbeWay::packets, &*seen);
  }

  std::optional<std::vector<bool>> occluded_seen_from(const Vec3f& place, bool infinitely_far,
                                                      std::span<const ProbeRay> all) const override {
    const auto seen = seen_from({place, infinitely_far});
    if (!seen) return std::nullopt;
    return occluded(all, ProbeWay::packets, &*seen);
  }

  std::vector<ProbeHit> intersect_embree(std::span<const ProbeRay> all, int packet_size) const override {
    std::vector<ProbeRay> shortened(all.begin(), all.end());
    std::vector<ProbeHit> result(all.size());
    for_each_packet(all, [&](std::size_t first, std::size_t count, Ray<FloatN>& rays, const MaskN& active) {
      const Hits hits = accelerator_.intersect_unbounded(rays, active);
      const std::uint32_t lanes = bits_of<FloatN>(hits.hit);
      for (std::size_t i = 0; i < count; ++i)
        if ((lanes >> i & 1) != 0) {
          ProbeHit& hit = result[first + i];
          hit.hit = true;
          hit.distance = shortened[first + i].far = rays.far.get(i);
          hit.kind = hits.geometry.get(i);
          hit.index = static_cast<std::uint32_t>(hits.primitive.get(i));
        }
    });
    const RTCScene scene = accelerator_.embree_scene();
    const auto nearer = packet_size == 4   ? EmbreePackets<4>::intersect(scene, shortened)
                        : packet_size == 8 ? EmbreePackets<8>::intersect(scene, shortened)
                                           : EmbreePackets<16>::intersect(scene, shortened);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (nearer[i].hit) result[i] = nearer[i];
    return result;
  }

  std::vector<bool> occluded_embree(std::span<const ProbeRay> all, int packet_size) const override {
    const RTCScene scene = accelerator_.embree_scene();
    std::vector<bool> result = packet_size == 4   ? EmbreePackets<4>::occluded(scene, all)
                               : packet_size == 8 ? EmbreePackets<8>::occluded(scene, all)
                                                  : EmbreePackets<16>::occluded(scene, all);
    for_each_packet(all, [&](std::size_t first, std::size_t count, const Ray<FloatN>& rays, const MaskN& active) {
      const std::uint32_t lanes = bits_of<FloatN>(accelerator_.occluded_unbounded(rays, active));
      for (std::size_t i = 0; i < count; ++i) result[first + i] = result[first + i] || (lanes >> i & 1) != 0;
    });
    return result;
  }

 private:
  static constexpr const char* embree_isa = register_lanes == 16 ? "avx512" : register_lanes == 8 ? "avx2" : "sse4.2";

  const Accelerator& accelerator(ProbeWay way) const { return way == ProbeWay::single ? embree_alone_ : accelerator_; }
  static Coherence coherence(ProbeWay way) {
    return way == ProbeWay::packets ? Coherence::coherent : Coherence::incoherent;
  }

  std::vector<ProbeHit> intersect(std::span<const ProbeRay> all, ProbeWay way, const DirectionBuffer* seen) const {
    std::vector<ProbeHit> result(all.size());
    for_each_packet(all, [&](std::size_t first, std::size_t count, Ray<FloatN>& rays, const MaskN& active) {
      const Hits hits = accelerator(way).intersect(rays, active, coherence(way), seen);
      const std::uint32_t lanes = bits_of<FloatN>(hits.hit);
      if (lanes == 0) return;
      const SurfaceInteraction<FloatN> surface = accelerator_.surface(rays, hits);
      const Vec3<FloatN> leaving = offset_ray_origin(surface);
      for (std::size_t i = 0; i < count; ++i)
        if ((lanes >> i & 1) != 0)
          result[first + i] = {true,
                               rays.far.get(i),
                               hits.geometry.get(i),
                               static_cast<std::uint32_t>(hits.primitive.get(i)),
                               lane_of(surface.p, i),
                               lane_of(surface.ng, i),
                               lane_of(leaving, i)};
    });
    return result;
  }

  std::vector<bool> occluded(std::span<const ProbeRay> all, ProbeWay way, const DirectionBuffer* seen) const {
    std::vector<bool> result(all.size());
    for_each_packet(all, [&](std::size_t first, std::size_t count, const Ray<FloatN>& rays, const MaskN& active) {
      const std::uint32_t lanes = bits_of<FloatN>(accelerator(way).occluded(rays, active, coherence(way), seen));
      for (std::size_t i = 0; i < count; ++i) result[first + i] = (lanes >> i & 1) != 0;
    });
    return result;
  }

  std::optional<DirectionBuffer> seen_from(const BufferOrigin& origin) const {
    return std::move(accelerator_.direction_buffers(std::array<std::optional<BufferOrigin>, 1>{origin}, 2).front());
  }

  SceneTables tables_;
  Accelerator accelerator_, embree_alone_;
};

}  // namespace

}  // namespace raytrace::test

#define RAYTRACE_JOIN_NAMES(a, b) a##b
#define RAYTRACE_JOIN(a, b) RAYTRACE_JOIN_NAMES(a, b)

/// The caller owns the result.
extern "C" raytrace::test::ProbeBackend* RAYTRACE_JOIN(raytrace_probe_, RAYTRACE_VARIANT)(
    const raytrace::SceneDescription& description) {
  return new raytrace::test::Backend(description);
}
