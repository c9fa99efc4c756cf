#include "raytrace/accel/accelerator.h"

#include <atomic>
#include <new>
#include <string>

#include "raytrace/accel/for_each_candidate.h"
#include "raytrace/math/gather.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/parallel/handover.h"
#include "raytrace/render/renderer.h"

namespace raytrace {

namespace {

/// Embree's packets are a register wide.
using Packet = embree::Packet<register_lanes>;
constexpr int registers = packet_lanes / register_lanes;

/// Embree asserts |component| < 1.844e18 for every ray and aborts otherwise, where it is built with assertions as
/// Debian's is. NaN fails every comparison.
RAYTRACE_INLINE MaskN embree_takes(const Ray<FloatN>& rays) {
  // Of a whole vector at once: the sum of its components' sizes is NaN or infinite if any of them is.
  const auto size = [](const Vec3<FloatN>& v) { return abs(v.x) + abs(v.y) + abs(v.z); };
  const FloatN direction = size(rays.direction);
  // Directions whose square would vanish in float count as 0.
  return (size(rays.origin) + direction < FloatN(1.8e18f)) & (direction > FloatN(1e-18f)) & (rays.near >= FloatN(0)) &
         (rays.far > rays.near);
}

// A packet of ours in as many of Embree's, whose arrays of a field are field(0), field(1).

template <class Batch, class Field>
RAYTRACE_INLINE void store(const Batch& values, const Field& field) {
  if constexpr (is_twin<Batch>) {
    values.lower().store_aligned(field(0));
    values.upper().store_aligned(field(1));
  } else {
    values.store_aligned(field(0));
  }
}

template <class Batch, class Field>
RAYTRACE_INLINE Batch load(const Field& field) {
  if constexpr (is_twin<Batch>) {
    return {Batch::Part::load_aligned(field(0)), Batch::Part::load_aligned(field(1))};
  } else {
    return Batch::load_aligned(field(0));
  }
}

struct ValidLanes {
  alignas(64) int lanes[registers][register_lanes];

  explicit ValidLanes(const MaskN& active) {
    store(same_bits<IntN>(select(active, same_bits<FloatN>(IntN(-1)), FloatN(0))),
          [&](int i) { return lanes[i]; });
  }
};

/// ray(i): Embree's packet number i.
template <class EmbreeRay>
void store_rays(const Ray<FloatN>& rays, const EmbreeRay& ray) {
  store(rays.origin.x, [&](int i) { return ray(i).org_x; });
  store(rays.origin.y, [&](int i) { return ray(i).org_y; });
  store(rays.origin.z, [&](int i) { return ray(i).org_z; });
  store(rays.near, [&](int i) { return ray(i).tnear; });
  store(rays.direction.x, [&](int i) { return ray(i).dir_x; });
  store(rays.direction.y, [&](int i) { return ray(i).dir_y; });
  store(rays.direction.z, [&](int i) { return ray(i).dir_z; });
  store(FloatN(0), [&](int i) { return ray(i).time; });
  store(rays.far, [&](int i) { return ray(i).tfar; });
  store(UintN(0xffffffffu), [&](int i) { return ray(i).mask; });
  store(UintN(0), [&](int i) { return ray(i).id; });
  store(UintN(0), [&](int i) { return ray(i).flags; });
}

/// Calls f(packet, lane) for each of the packet's lanes that are set, Embree's packet and the lane in it.
template <class Function>
void for_each_lane(const MaskN& mask, const Function& f) {
  for (std::uint32_t lanes = bits_of<FloatN>(mask); lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    f(lane / register_lanes, lane % register_lanes);
  }
}

/// Calls f(packet) for each of Embree's packets that has a lane in the mask.
template <class Function>
void for_each_packet(const MaskN& mask, const Function& f) {
  constexpr std::uint32_t all = (std::uint64_t{1} << register_lanes) - 1;
  const std::uint32_t lanes = bits_of<FloatN>(mask);
  for (int i = 0; i < registers; ++i)
    if ((lanes >> (i * register_lanes) & all) != 0) f(i);
}

RTCRay single_ray(const typename Packet::Ray& rays, int lane) {
  RTCRay ray{};
  ray.org_x = rays.org_x[lane];
  ray.org_y = rays.org_y[lane];
  ray.org_z = rays.org_z[lane];
  ray.tnear = rays.tnear[lane];
  ray.dir_x = rays.dir_x[lane];
  ray.dir_y = rays.dir_y[lane];
  ray.dir_z = rays.dir_z[lane];
  ray.tfar = rays.tfar[lane];
  ray.mask = rays.mask[lane];
  return ray;
}

[[noreturn]] void throw_embree_error(RTCError code, const char* message) {
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw RenderError(std::string("Embree: ") + (message != nullptr ? message : "unknown error"));
}

/// What Embree's callbacks report, to be thrown where it is safe: not through Embree's own frames.
struct BuildReport {
  std::atomic<std::int64_t> bytes{0};
  RTCError error = RTC_ERROR_NONE;
  std::string message;
};

void on_error(void* user, RTCError code, const char* message) {
  auto& report = *static_cast<BuildReport*>(user);
  if (report.error != RTC_ERROR_NONE) return;
  report.error = code;
  report.message = message != nullptr ? message : "";
}

/// Embree's builder threads see the report that the constructor made.
constinit Handover report_made;

bool on_memory(void* user, ssize_t bytes, bool) {
  report_made.take();
  static_cast<BuildReport*>(user)->bytes += bytes;
  return true;
}

template <class Shape>
void fill_table(const SceneDescription& description, ShapeTable<Shape>& table) {
  const auto& items = std::get<ObjectItems<Shape>>(description.objects);
  table.records.reserve(items.size() + 1);  // Embree reads whole 16 byte words of the last vertex
  for (const auto& item : items) table.records.push_back(Shape::record(item.parameters));
}

/// Embree's triangles, straight from the table.
template <class Shape>
embree::Geometry make_triangles(RTCDevice device, const ShapeTable<Shape>& table) {
  const auto count = static_cast<unsigned>(table.records.size());
  embree::Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, table.records.data(), 0,
                             sizeof(Vec3f), 3 * static_cast<std::size_t>(count));
  auto* index = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
  if (index == nullptr) throw std::bad_alloc();
  for (unsigned i = 0; i < 3 * count; ++i) index[i] = i;
  return geometry;
}

/// Calls f(kind, primitive, record) for each object of the shapes without end.
template <class Tables, class Function>
RAYTRACE_INLINE void for_each_unbounded(const Tables& tables, Function f) {
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    if constexpr (UnboundedShape<Shape>) {
      std::uint32_t primitive = 0;
      for (const auto& record : std::get<ShapeTable<Shape>>(tables).records) f(type, primitive++, record);
    }
  });
}

RAYTRACE_INLINE void find_first(Hits& hits) {
  const std::uint32_t lanes = bits_of<FloatN>(hits.hit);
  if (lanes == 0) return;
  const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
  hits.first_kind = hits.kind.get(lane);
  hits.first_primitive = hits.primitive.get(lane);
  hits.one_kind = none(hits.hit & float_mask<FloatN>(hits.kind != UintN(hits.first_kind)));
  hits.one_object =
      hits.one_kind && none(hits.hit & float_mask<FloatN>(hits.primitive != IntN(hits.first_primitive)));
}

template <class Shape>
PlacedObject placed_object(const typename ShapeTable<Shape>::Record& record, std::uint32_t primitive) {
  const Bounds bounds = Shape::bounds(record);
  double radius = length(Vec3d(bounds.upper) - Vec3d(bounds.lower)) / 2;
  if constexpr (requires { Shape::bounding_radius(record); }) radius = std::min(radius, Shape::bounding_radius(record));
  return {static_cast<std::uint32_t>(index_of<Shape>(Shapes{})), primitive, bounds, radius};
}

/// Where rays meet an object: at infinity in lanes that do not. u, v: set on triangles.
template <class Tables>
RAYTRACE_INLINE FloatN meet(const Tables& tables, const DirectionBuffer::Object& object, const Ray<FloatN>& rays,
                            const MaskN& active, FloatN& u, FloatN& v) {
  return with_type(Shapes{}, object.kind, [&](auto type) {
    using Shape = typename decltype(type)::type;
    const auto& record = std::get<ShapeTable<Shape>>(tables).records[object.primitive];
    if constexpr (EmbreeTriangle<Shape>) {
      return Shape::template intersect<FloatN>(record, rays, active, u, v);
    } else {
      return Shape::template intersect<FloatN>(record, rays, active);
    }
  });
}

/// The surfaces of one shape, under the wide type of its table's precision.
template <class Shape>
SurfacePoint<FloatN> surface_of(const ShapeTable<Shape>& table, const LanePlaces& primitive, const Ray<FloatN>& rays,
                                const Hits& hits) {
  if constexpr (requires { Shape::surface(table.records[0], rays, hits.distance); })
    if (primitive.all_same()) return Shape::surface(table.records[primitive.first()], rays, hits.distance);
  constexpr bool in_float = std::is_same_v<typename ShapeTable<Shape>::Record, typename Shape::template Record<float>>;
  using Wide = std::conditional_t<in_float, FloatN, Doubles<FloatN>>;
  const auto records = gather_records<Shape::template Record, Wide>(table.records.data(), primitive);
  if constexpr (EmbreeTriangle<Shape>) {
    return Shape::template surface<FloatN>(records, hits.u, hits.v);
  } else {
    return Shape::template surface<FloatN>(records, rays, hits.distance);
  }
}

}  // namespace

Accelerator::Accelerator(const SceneDescription& description, int threads, const char* isa) {
  BuildReport report;
  report_made.give();
  const std::string configuration = "threads=" + std::to_string(threads) + ",set_affinity=0,isa=" + isa;
  device_.reset(rtcNewDevice(configuration.c_str()));
  if (!device_) throw_embree_error(rtcGetDeviceError(nullptr), "no device could be created");
  rtcSetDeviceErrorFunction(device_.get(), &on_error, &report);
  rtcSetDeviceMemoryMonitorFunction(device_.get(), &on_memory, &report);

  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);  // no misses at box borders far from the origin
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    auto& table = std::get<ShapeTable<Shape>>(tables_);
    fill_table(description, table);
    if constexpr (!UnboundedShape<Shape>) {
      if (table.records.empty()) return;
      embree::Geometry geometry;
      if constexpr (UserGeometry<Shape>) {
        geometry = make_user_geometry(device_.get(), table);
      } else {
        geometry = make_triangles(device_.get(), table);
      }
      rtcCommitGeometry(geometry.get());
      rtcAttachGeometryByID(scene_.get(), geometry.get(), static_cast<unsigned>(index_of<Shape>(Shapes{})));
    }
  });
  commit_scene(scene_.get());
  bytes_ = static_cast<std::uint64_t>(std::max<std::int64_t>(report.bytes, 0));
  rtcSetDeviceMemoryMonitorFunction(device_.get(), nullptr, nullptr);
  rtcSetDeviceErrorFunction(device_.get(), nullptr, nullptr);
  if (report.error != RTC_ERROR_NONE) throw_embree_error(report.error, report.message.c_str());
}

Hits Accelerator::intersect_unbounded(const Ray<FloatN>& rays, const MaskN& active) const {
  Hits hits;
  hits.kind = UintN(RTC_INVALID_GEOMETRY_ID);
  hits.primitive = IntN(0);
  hits.distance = rays.far;
  hits.u = hits.v = FloatN(0);
  for_each_unbounded(tables_, [&](auto type, std::uint32_t primitive, const auto& record) RAYTRACE_INLINE_LAMBDA {
    using Shape = typename decltype(type)::type;
    const FloatN t = Shape::template intersect<FloatN>(record, rays, active);
    const MaskN hit = t < hits.distance;
    hits.distance = select(hit, t, hits.distance);
    hits.kind = select_lanes(hit, UintN(static_cast<std::uint32_t>(index_of<Shape>(Shapes{}))), hits.kind);
    hits.primitive = select_lanes(hit, IntN(static_cast<std::int32_t>(primitive)), hits.primitive);
  });
  hits.hit = float_mask<FloatN>(hits.kind != UintN(RTC_INVALID_GEOMETRY_ID));
  return hits;
}

MaskN Accelerator::occluded_unbounded(const Ray<FloatN>& rays, const MaskN& active) const {
  MaskN occluded(false);
  for_each_unbounded(tables_, [&](auto type, std::uint32_t, const auto& record) RAYTRACE_INLINE_LAMBDA {
    using Shape = typename decltype(type)::type;
    occluded = occluded | (Shape::template intersect<FloatN>(record, rays, active) < infinity<FloatN>());
  });
  return occluded;
}

std::vector<std::optional<DirectionBuffer>> Accelerator::seen_from(std::span<const std::optional<Vantage>> vantages,
                                                                   int threads) const {
  std::vector<PlacedObject> objects;
  objects.reserve(primitive_count());
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    if constexpr (!UnboundedShape<Shape>) {
      std::uint32_t primitive = 0;
      for (const auto& record : std::get<ShapeTable<Shape>>(tables_).records)
        objects.push_back(placed_object<Shape>(record, primitive++));
    }
  });
  std::vector<std::optional<DirectionBuffer>> buffers(vantages.size());
  for_each_index(static_cast<int>(vantages.size()), threads, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    if (vantages[i]) buffers[i] = DirectionBuffer::make(*vantages[i], objects);
  });
  return buffers;
}

MaskN Accelerator::intersect_candidates(const DirectionBuffer& seen, const Ray<FloatN>& rays, const MaskN& active,
                                        Hits& hits) const {
  const auto reaches = [&](const MaskN& lanes, const DirectionBuffer::Object& object) {
    return any(lanes & (hits.distance * hits.distance >= FloatN(object.nearest)));
  };
  const auto test = [&](const DirectionBuffer::Object& object) {
    const Ray<FloatN> shortened{rays.origin, rays.direction, rays.near, hits.distance};
    FloatN u = hits.u, v = hits.v;
    const FloatN distance = meet(tables_, object, shortened, active, u, v);
    const MaskN hit = distance < infinity<FloatN>();  // in float it may be the same as the one before
    if (none(hit)) return;
    hits.hit = hits.hit | hit;
    hits.distance = select(hit, distance, hits.distance);
    hits.u = select(hit, u, hits.u);
    hits.v = select(hit, v, hits.v);
    hits.kind = select_lanes(hit, UintN(object.kind), hits.kind);
    hits.primitive = select_lanes(hit, IntN(static_cast<std::int32_t>(object.primitive)), hits.primitive);
  };
  return for_each_candidate(seen, rays.direction, active, reaches, test);
}

MaskN Accelerator::occluded_by_candidates(const DirectionBuffer& seen, const Ray<FloatN>& rays, const MaskN& active,
                                          MaskN& occluded) const {
  const auto sight = seen.sight(rays.origin, rays.direction);
  const MaskN in_reach = seen.in_reach(rays.origin, rays.direction);
  MaskN open = active;
  const auto reaches = [&](const MaskN& lanes, const DirectionBuffer::Object& object) {
    return any(lanes & open & (sight.depth >= FloatN(object.nearest)));
  };
  const auto test = [&](const DirectionBuffer::Object& object) {
    FloatN u, v;
    open = open & !(meet(tables_, object, rays, open, u, v) < infinity<FloatN>());
  };
  const MaskN left = for_each_candidate(seen, sight.direction, active & in_reach, reaches, test);
  occluded = occluded | (active & !open);
  return open & (left | !in_reach);
}

Hits Accelerator::intersect(const Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                            const DirectionBuffer* seen_from_origin) const {
  MaskN valid_lanes = active & embree_takes(rays);
  // First the shapes without end: what lies behind their hits need not be looked for.
  Hits hits = intersect_unbounded(rays, valid_lanes);
  if (seen_from_origin != nullptr) {
    valid_lanes = intersect_candidates(*seen_from_origin, rays, valid_lanes, hits);
    find_first(hits);
  }
  if (none(valid_lanes)) return hits;

  embree::Query query(coherence == Coherence::coherent);
  alignas(64) typename Packet::RayHit packets[registers];
  store_rays({rays.origin, rays.direction, rays.near, hits.distance}, [&](int i) -> auto& { return packets[i].ray; });
  store(UintN(RTC_INVALID_GEOMETRY_ID), [&](int i) { return packets[i].hit.geomID; });
  store(UintN(RTC_INVALID_GEOMETRY_ID), [&](int i) { return packets[i].hit.instID[0]; });
  if (coherence == Coherence::coherent) {
    const ValidLanes valid(valid_lanes);
    for_each_packet(valid_lanes, [&](int i) { Packet::intersect(valid.lanes[i], scene_.get(), query, packets[i]); });
  } else {
    for_each_lane(valid_lanes, [&](int i, int lane) {
      auto& packet = packets[i];
      RTCRayHit single{};
      single.ray = single_ray(packet.ray, lane);
      single.hit.geomID = single.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      embree::intersect1(scene_.get(), query, single);
      packet.ray.tfar[lane] = single.ray.tfar;
      packet.hit.u[lane] = single.hit.u;
      packet.hit.v[lane] = single.hit.v;
      packet.hit.primID[lane] = single.hit.primID;
      packet.hit.geomID[lane] = single.hit.geomID;
    });
  }
  const UintN kind = load<UintN>([&](int i) { return packets[i].hit.geomID; });
  const MaskN in_bvh = valid_lanes & float_mask<FloatN>(kind != UintN(RTC_INVALID_GEOMETRY_ID));
  hits.hit = hits.hit | in_bvh;
  hits.kind = select_lanes(in_bvh, kind, hits.kind);
  const UintN primitive = load<UintN>([&](int i) { return packets[i].hit.primID; });
  hits.primitive = select_lanes(in_bvh, same_bits<IntN>(primitive), hits.primitive);
  hits.distance = load<FloatN>([&](int i) { return packets[i].ray.tfar; });
  hits.u = select(in_bvh, load<FloatN>([&](int i) { return packets[i].hit.u; }), hits.u);
  hits.v = select(in_bvh, load<FloatN>([&](int i) { return packets[i].hit.v; }), hits.v);
  find_first(hits);
  return hits;
}

MaskN Accelerator::occluded(const Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                            const DirectionBuffer* seen_from_end) const {
  const MaskN takeable = active & embree_takes(rays);
  MaskN found = occluded_unbounded(rays, takeable);
  MaskN valid_lanes = takeable & !found;
  if (seen_from_end != nullptr) valid_lanes = occluded_by_candidates(*seen_from_end, rays, valid_lanes, found);
  if (none(valid_lanes)) return found;

  embree::Query query(coherence == Coherence::coherent);
  alignas(64) typename Packet::Ray packets[registers];
  store_rays(rays, [&](int i) -> auto& { return packets[i]; });
  if (coherence == Coherence::coherent) {
    const ValidLanes valid(valid_lanes);
    for_each_packet(valid_lanes, [&](int i) { Packet::occluded(valid.lanes[i], scene_.get(), query, packets[i]); });
  } else {
    for_each_lane(valid_lanes, [&](int i, int lane) {
      RTCRay single = single_ray(packets[i], lane);
      embree::occluded1(scene_.get(), query, single);
      packets[i].tfar[lane] = single.tfar;
    });
  }
  return found | (valid_lanes & (load<FloatN>([&](int i) { return packets[i].tfar; }) < FloatN(0)));
}

SurfacePoint<FloatN> Accelerator::surface(const Ray<FloatN>& rays, const Hits& hits) const {
  if (hits.one_object) {
    return with_type(Shapes{}, hits.first_kind, [&](auto type) {
      using Shape = typename decltype(type)::type;
      return surface_of<Shape>(std::get<ShapeTable<Shape>>(tables_), LanePlaces(hits.first_primitive), rays, hits);
    });
  }
  std::uint32_t lanes_left = bits_of<FloatN>(hits.hit);
  alignas(64) std::uint32_t kinds[packet_lanes];
  hits.kind.store_aligned(kinds);
  SurfacePoint<FloatN> result{};
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    const auto kind = static_cast<std::uint32_t>(index_of<Shape>(Shapes{}));
    if (lanes_left == 0 || std::get<ShapeTable<Shape>>(tables_).records.empty()) return;
    const MaskN here =
        hits.hit & float_mask<FloatN>(same_bits<IntN>(hits.kind) == IntN(static_cast<std::int32_t>(kind)));
    const std::uint32_t lanes = bits_of<FloatN>(here);
    if (lanes == 0) return;
    lanes_left &= ~lanes;
    // The other lanes follow the first of these, so that they read a record that exists, and no further ones.
    const IntN primitive =
        select_lanes(here, hits.primitive, IntN(hits.primitive.get(static_cast<std::size_t>(std::countr_zero(lanes)))));
    result = select(here, surface_of<Shape>(std::get<ShapeTable<Shape>>(tables_), primitive, rays, hits), result);
  });
  return result;
}

std::uint64_t Accelerator::primitive_count() const {
  return std::apply([](const auto&... table) { return (std::uint64_t{table.records.size()} + ...); }, tables_);
}

std::string Accelerator::embree_version() const {
  const auto number = [&](RTCDeviceProperty property) {
    return std::to_string(rtcGetDeviceProperty(device_.get(), property));
  };
  return number(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + '.' + number(RTC_DEVICE_PROPERTY_VERSION_MINOR) + '.' +
         number(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

}  // namespace raytrace
