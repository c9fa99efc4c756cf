#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <bit>
#include <chrono>
#include <numeric>

#include "ceiling.h"
#include "raytrace/integrators/secondary_ray.h"
#include "raytrace/sampling/pixel_sampler.h"
#include "raytrace/scene/traced_scene.h"

namespace raytrace::benchmark {

namespace {

using Packet = embree::Packet<packet_lanes>;

constexpr int block_width = packet_lanes >= 8 ? 4 : 2;
constexpr int block_height = packet_lanes / block_width;
constexpr int tile_edge = 16;  ///< small enough that a tile's rays stay in the second level cache

struct CameraPacket {
  alignas(64) typename Packet::RayHit rays;
  alignas(64) int valid[packet_lanes];
};
struct ShadowPacket {
  alignas(64) typename Packet::Ray rays;
  alignas(64) int valid[packet_lanes];
};

template <class EmbreeRays>
void store(const Ray<FloatN>& rays, EmbreeRays& out) {
  rays.origin.x.store_aligned(out.org_x);
  rays.origin.y.store_aligned(out.org_y);
  rays.origin.z.store_aligned(out.org_z);
  rays.direction.x.store_aligned(out.dir_x);
  rays.direction.y.store_aligned(out.dir_y);
  rays.direction.z.store_aligned(out.dir_z);
  rays.near.store_aligned(out.tnear);
  rays.far.store_aligned(out.tfar);
  for (int lane = 0; lane < packet_lanes; ++lane) {
    out.time[lane] = 0;
    out.mask[lane] = 0xffffffffu;
    out.id[lane] = out.flags[lane] = 0;
  }
}

void store_valid(const MaskN& mask, int* valid) {
  const std::uint32_t bits = bits_of<FloatN>(mask);
  for (int lane = 0; lane < packet_lanes; ++lane) valid[lane] = (bits >> lane & 1) != 0 ? -1 : 0;
}

template <class EmbreeRays>
Ray<FloatN> load(const EmbreeRays& rays) {
  const auto field = [](const float* lanes) { return FloatN::load_aligned(lanes); };
  return {{field(rays.org_x), field(rays.org_y), field(rays.org_z)},
          {field(rays.dir_x), field(rays.dir_y), field(rays.dir_z)},
          field(rays.tnear),
          field(rays.tfar)};
}

/// A plane in a box as large as Embree takes.
struct BoxedPlane : Plane {
  static Bounds bounds(const Record<double>&) { return {{-1e18F, -1e18F, -1e18F}, {1e18F, 1e18F, 1e18F}}; }
};

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
      const auto record = Sphere::record(item.parameters);
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
    const int columns = (scene_.viewplane().hres + tile_edge - 1) / tile_edge;
    const int rows = (scene_.viewplane().vres + tile_edge - 1) / tile_edge;
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
    for (int first = 0; first < scene_.viewplane().samples; first += 16) {
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
      const Hits hits = scene_.accelerator().intersect_unbounded(load(packet.rays.ray), MaskN(true));
      hits.distance.store_aligned(packet.rays.ray.tfar);
    }
    embree::Query query(true);
    Packet::intersect(packet.valid, embree_scene(), query, packet.rays);
  }

  void occluded(ShadowPacket& packet) const {
    if (bare_ == BareLoop::parts) {
      const MaskN valid = float_mask<FloatN>(IntN::load_aligned(packet.valid) != IntN(0));
      const MaskN left = valid & !scene_.accelerator().occluded_unbounded(load(packet.rays), valid);
      if (none(left)) return;
      store_valid(left, packet.valid);
    }
    embree::Query query(true);
    Packet::occluded(packet.valid, embree_scene(), query, packet.rays);
  }

  RTCScene embree_scene() const {
    return embree_spheres_ ? embree_spheres_->scene() : scene_.accelerator().embree_scene();
  }

  /// To Embree's scene, where the renderer has none.
  void add_planes(const SceneDescription& description) {
    for (const auto& item : std::get<ObjectItems<Plane>>(description.objects))
      planes_.records.push_back(Plane::record(item.parameters));
    const embree::Geometry planes = make_user_geometry(rtcGetSceneDevice(embree_scene()), planes_);
    rtcCommitGeometry(planes.get());
    rtcAttachGeometry(embree_scene(), planes.get());
    rtcCommitScene(embree_scene());
  }

  /// The rays of up to 16 samples of a block, as the renderer makes them.
  void make_rays(int left, int top, int first_sample, std::vector<CameraPacket>& camera,
                 std::vector<ShadowPacket>& shadow, RayCounts& counts) const {
    const ViewPlane& viewplane = scene_.viewplane();
    alignas(64) std::uint32_t columns[packet_lanes], rows[packet_lanes];
    alignas(64) float xs[packet_lanes], ys[packet_lanes];
    for (int lane = 0; lane < packet_lanes; ++lane) {
      const int column = left + lane % block_width, row = top + lane / block_width;
      columns[lane] = static_cast<std::uint32_t>(column);
      rows[lane] = static_cast<std::uint32_t>(row);
      xs[lane] = static_cast<float>(column) - static_cast<float>(viewplane.hres) / 2;
      ys[lane] = static_cast<float>(viewplane.vres) / 2 - 1 - static_cast<float>(row);
    }
    PixelSampler sampler(UintN::load_aligned(columns), UintN::load_aligned(rows), UintN(0u), 1, 0, 0,
                         viewplane.samples == 1);
    for (int sample = 0; sample < std::min(first_sample + 16, viewplane.samples); ++sample) {
      const PixelSampler::Point point = sampler.next();
      if (sample < first_sample) continue;
      const MaskN all(true);
      const Ray<FloatN> rays =
          scene_.camera().generate(FloatN::load_aligned(xs) + point.x, FloatN::load_aligned(ys) + point.y);
      CameraPacket& packet = camera.emplace_back();
      store(rays, packet.rays.ray);
      store_valid(all, packet.valid);
      for (int lane = 0; lane < packet_lanes; ++lane) packet.rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      counts.camera += packet_lanes;

      const Hits hits = scene_.accelerator().intersect(rays, all, Coherence::coherent);
      if (none(hits.hit)) continue;
      SurfacePoint<FloatN> surface = scene_.accelerator().surface(rays, hits);
      surface.normal = select(dot(surface.normal, rays.direction) > FloatN(0), -surface.normal, surface.normal);
      const Vec3<FloatN> origin = leaving_origin(surface);
      for (const auto& light : scene_.lights()) {
        const MaskN lit = hits.hit & (dot(surface.normal, light->sample(surface.position).to_light) > FloatN(0));
        if (none(lit)) continue;
        const LightSample<FloatN> to_light = light->sample(origin);
        ShadowPacket& shadow_packet = shadow.emplace_back();
        store(Ray<FloatN>{origin, to_light.to_light, FloatN(0), to_light.end}, shadow_packet.rays);
        store_valid(lit, shadow_packet.valid);
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
