#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <bit>
#include <chrono>
#include <numeric>

#include "ceiling.h"
#include "raytrace/accel/embree_packets.h"
#include "raytrace/accel/traced_scene.h"
#include "raytrace/sampling/pixel_sampler.h"

namespace raytrace::benchmark {

namespace {

constexpr int block_width = 4;
constexpr int block_height = packet_lanes / block_width;
constexpr int tile_edge = 16;  ///< small enough that a tile's rays stay in the second level cache

struct CameraPacket {
  alignas(64) embree::RegisterPacket::RayHit rays[embree::packets];
  MaskN valid;

  auto ray() {
    return [this](int i) -> auto& { return rays[i].ray; };
  }
};
struct ShadowPacket {
  alignas(64) embree::RegisterPacket::Ray rays[embree::packets];
  MaskN valid;

  auto ray() {
    return [this](int i) -> auto& { return rays[i]; };
  }
};

/// A plane in a box as large as Embree takes.
struct BoxedPlane : Plane {};

}  // namespace

}  // namespace raytrace::benchmark

template <>
class raytrace::Kernel<raytrace::benchmark::BoxedPlane> : public raytrace::Kernel<raytrace::Plane> {
 public:
  static Bounds bounds(const Record&) { return {{-1e18F, -1e18F, -1e18F}, {1e18F, 1e18F, 1e18F}}; }
};

namespace raytrace::benchmark {

namespace {

/// Everything in one scene of Embree's, spheres as its own geometry.
class EmbreeSpheres {
 public:
  explicit EmbreeSpheres(const SceneDescription& description)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
    const auto& spheres = std::get<ObjectItems<Sphere>>(description.objects);
    const embree::Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT));
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0,
                                                                 RTC_FORMAT_FLOAT4, 4 * sizeof(float), spheres.size()));
    for (const auto& item : spheres) {
      const auto record = Kernel<Sphere>::record(item.parameters);
      for (const float value : {record.center.x, record.center.y, record.center.z, record.radius}) *vertices++ = value;
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  }
  RTCScene scene() const { return scene_.get(); }

 private:
  embree::Device device_;
  embree::Scene scene_;
};

class CeilingOfVariant final : public Ceiling {
 public:
  CeilingOfVariant(const SceneDescription& description, BareLoop bare)
      : scene_(description, 0, "",
               register_lanes == 16  ? "avx512"
               : register_lanes == 8 ? "avx2"
                                     : "sse4.2"),
        bare_(bare) {
    if (bare == BareLoop::embree_spheres) embree_spheres_ = std::make_unique<EmbreeSpheres>(description);
    if (bare != BareLoop::parts) add_planes(description);
  }

  CeilingResult trace(int threads) const override {
    const int columns = (scene_.tables().viewplane().hres + tile_edge - 1) / tile_edge;
    const int rows = (scene_.tables().viewplane().vres + tile_edge - 1) / tile_edge;
    tbb::enumerable_thread_specific<CeilingResult> results;
    tbb::task_arena arena(threads);
    arena.execute([&] {
      tbb::parallel_for(0, columns * rows, [&](int tile) {
        trace_tile(tile % columns * tile_edge, tile / columns * tile_edge, results.local());
      });
    });
    CeilingResult sum;
    for (const CeilingResult& result : results) {
      sum.seconds += result.seconds;
      sum.rays += result.rays;
    }
    return sum;
  }

 private:
  void trace_tile(int left, int top, CeilingResult& result) const {
    thread_local std::vector<CameraPacket> camera;
    thread_local std::vector<ShadowPacket> shadow;
    for (int first = 0; first < scene_.tables().viewplane().samples; first += 16) {
      camera.clear();
      shadow.clear();
      for (int y = top; y < top + tile_edge; y += block_height)
        for (int x = left; x < left + tile_edge; x += block_width) make_rays(x, y, first, camera, shadow, result.rays);
      const auto start = std::chrono::steady_clock::now();
      for (CameraPacket& packet : camera) intersect(packet);
      for (ShadowPacket& packet : shadow) occluded(packet);
      result.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
  }

  void intersect(CameraPacket& packet) const {
    if (bare_ == BareLoop::parts) {
      Ray<FloatN> rays = embree::load_rays(packet.ray());
      scene_.accelerator().intersect_unbounded(rays, MaskN(true));
      embree::store(rays.far, [&](int i) { return packet.rays[i].ray.tfar; });
    }
    embree::Query query(true);
    embree::load<FloatN>([&](int i) { return packet.rays[i].ray.tfar; }).store_aligned(query.distance);
    UintN(embree::Query::none).store_aligned(query.geometry);
    UintN(0u).store_aligned(query.instance);
    const embree::ValidLanes valid(packet.valid);
    embree::for_each_packet(packet.valid, [&](int i) {
      embree::RegisterPacket::intersect(valid.lanes[i], embree_scene(), query, packet.rays[i]);
    });
  }

  void occluded(ShadowPacket& packet) const {
    MaskN left = packet.valid;
    if (bare_ == BareLoop::parts)
      left = left & !scene_.accelerator().occluded_unbounded(embree::load_rays(packet.ray()), left);
    embree::Query query(true);
    embree::load<FloatN>([&](int i) { return packet.rays[i].tfar; }).store_aligned(query.distance);
    const embree::ValidLanes valid(left);
    embree::for_each_packet(
        left, [&](int i) { embree::RegisterPacket::occluded(valid.lanes[i], embree_scene(), query, packet.rays[i]); });
  }

  RTCScene embree_scene() const {
    return embree_spheres_ ? embree_spheres_->scene() : scene_.accelerator().embree_scene();
  }

  /// To Embree's scene, where the renderer has none.
  void add_planes(const SceneDescription& description) {
    for (const auto& item : std::get<ObjectItems<Plane>>(description.objects))
      planes_.records.push_back(Kernel<Plane>::record(item.parameters));
    const embree::Geometry planes(rtcNewGeometry(rtcGetSceneDevice(embree_scene()), RTC_GEOMETRY_TYPE_USER));
    set_callbacks(planes.get(), planes_);
    rtcCommitGeometry(planes.get());
    rtcAttachGeometry(embree_scene(), planes.get());
    rtcCommitScene(embree_scene());
  }

  /// The rays of up to 16 samples of a block, as the renderer makes them.
  void make_rays(int left, int top, int first_sample, std::vector<CameraPacket>& camera,
                 std::vector<ShadowPacket>& shadow, RayCounts& counts) const {
    const ViewPlane& viewplane = scene_.tables().viewplane();
    alignas(64) std::uint32_t columns[packet_lanes], rows[packet_lanes];
    alignas(64) float xs[packet_lanes], ys[packet_lanes];
    for (int lane = 0; lane < packet_lanes; ++lane) {
      const int column = left + lane % block_width, row = top + lane / block_width;
      columns[lane] = static_cast<std::uint32_t>(column);
      rows[lane] = static_cast<std::uint32_t>(row);
      xs[lane] = static_cast<float>(column) - static_cast<float>(viewplane.hres) / 2;
      ys[lane] = static_cast<float>(viewplane.vres) / 2 - 1 - static_cast<float>(row);
    }
    PixelSampler sampler(PixelScramble(UintN::load_aligned(columns), UintN::load_aligned(rows), 0),
                         SampleGroup(UintN(0u), 1), 0, viewplane.samples == 1);
    for (int sample = 0; sample < std::min(first_sample + 16, viewplane.samples); ++sample) {
      const PixelSampler::Point point = sampler.next();
      if (sample < first_sample) continue;
      const MaskN all(true);
      CameraRays made;
      scene_.tables().set_camera_rays(FloatN::load_aligned(xs) + point.x, FloatN::load_aligned(ys) + point.y,
                                      {FloatN(0), FloatN(0)}, made);
      Ray<FloatN>& rays = made.rays;
      CameraPacket& packet = camera.emplace_back();
      embree::store_rays(rays, FloatN(0), packet.ray());
      embree::store(UintN(RTC_INVALID_GEOMETRY_ID), [&](int i) { return packet.rays[i].hit.geomID; });
      packet.valid = all;
      counts.camera += packet_lanes;

      const Hits hits = scene_.accelerator().intersect(rays, all, Coherence::coherent);
      if (none(hits.hit)) continue;
      const SurfaceInteraction<FloatN> surface = scene_.accelerator().surface(rays, hits);
      Ray<FloatN> shadow_rays;
      shadow_rays.origin = offset_ray_origin(surface);
      shadow_rays.near = FloatN(0);
      for (const auto& light : scene_.tables().lights()) {
        Rgb<FloatN> radiance;
        light->sample(shadow_rays, {FloatN(0), FloatN(0)}, radiance);
        const MaskN lit = hits.hit & (dot(surface.ng, shadow_rays.direction) > FloatN(0));
        if (none(lit)) continue;
        ShadowPacket& shadow_packet = shadow.emplace_back();
        embree::store_rays(shadow_rays, FloatN(0), shadow_packet.ray());
        shadow_packet.valid = lit;
        counts.shadow += static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(lit)));
      }
    }
  }

  ShapeTable<BoxedPlane> planes_;
  TracedScene scene_;
  BareLoop bare_;
  std::unique_ptr<EmbreeSpheres> embree_spheres_;
};

}  // namespace

}  // namespace raytrace::benchmark

#define RAYTRACE_JOIN_NAMES(a, b) a##b
#define RAYTRACE_JOIN(a, b) RAYTRACE_JOIN_NAMES(a, b)

/// The caller owns the result.
extern "C" raytrace::benchmark::Ceiling* RAYTRACE_JOIN(raytrace_ceiling_,
                                                       RAYTRACE_VARIANT)(const raytrace::SceneDescription& description,
                                                                         raytrace::benchmark::BareLoop bare) {
  return new raytrace::benchmark::CeilingOfVariant(description, bare);
}
