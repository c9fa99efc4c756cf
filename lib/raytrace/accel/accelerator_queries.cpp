// Accelerator's queries; what they ask is built in accelerator.cpp.
#include <bit>

#include "raytrace/accel/accelerator.h"
#include "raytrace/accel/embree_packets.h"
#include "raytrace/accel/for_each_candidate.h"
#include "raytrace/accel/intersect_object.h"
#include "raytrace/math/gather.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

namespace {

/// Embree asserts |component| < 1.844e18 for every ray and aborts otherwise, where it is built with assertions as
/// Debian's is. NaN fails every comparison.
RAYTRACE_INLINE MaskN embree_takes(const Ray<FloatN>& rays) {
  // Of a whole vector at once: the sum of its components' sizes is NaN or infinite if any of them is.
  const auto size = [](const Vec3<FloatN>& v) { return abs(v.x) + abs(v.y) + abs(v.z); };
  const FloatN direction = size(rays.direction);
  // Directions whose square would vanish in float count as 0.
  return (size(rays.origin) + direction < FloatN(1.8e18f)) & (direction > FloatN(1e-18f)) & (rays.far > rays.near);
}

RTCRay single_ray(const embree::RegisterPacket::Ray& rays, int lane) {
  RTCRay ray{};
  ray.org_x = rays.org_x[lane];
  ray.org_y = rays.org_y[lane];
  ray.org_z = rays.org_z[lane];
  ray.tnear = rays.tnear[lane];
  ray.dir_x = rays.dir_x[lane];
  ray.dir_y = rays.dir_y[lane];
  ray.dir_z = rays.dir_z[lane];
  ray.tfar = rays.tfar[lane];
  ray.time = rays.time[lane];
  ray.mask = rays.mask[lane];
  ray.id = rays.id[lane];
  return ray;
}

/// Of a query's identity, which may be null: what its callbacks need where rays pass surfaces, else null.
const RayIdentity* cutouts_of(const RayIdentity* identity) {
  return identity != nullptr && identity->scene.has_cutouts() ? identity : nullptr;
}
FloatN times_of(const RayIdentity* identity) { return identity != nullptr ? identity->times : FloatN(0); }

/// Calls f(shape_type, primitive, record) for each object of the shapes without end.
template <class Tables, class Function>
RAYTRACE_INLINE void for_each_unbounded(const Tables& tables, Function f) {
  for_each_type(Shapes{}, [&](auto type) RAYTRACE_INLINE_LAMBDA {
    using Shape = typename decltype(type)::type;
    if constexpr (UnboundedShape<Shape>) {
      std::uint32_t primitive = 0;
      for (const auto& record : tables.template table<Shape>().records) f(type, primitive++, record);
    }
  });
}

/// Shapes that take rays from a point as such.
template <class Shape>
concept TakesRaysFromPoint =
    requires(typename ShapeTable<Shape>::Record record, RaysFromPoint<FloatN> rays, MaskN active, FloatN u) {
      Kernel<Shape>::template intersect<FloatN>(record, rays, active);
    } || requires(typename ShapeTable<Shape>::Record record, RaysFromPoint<FloatN> rays, MaskN active, FloatN u) {
      Kernel<Shape>::template intersect<FloatN>(record, rays, active, u, u);
    };

/// Whether the object lies on the rays.
template <class Tables>
RAYTRACE_INLINE MaskN is_occluded(const Tables& tables, const DirectionBuffer::Object& object, const Ray<FloatN>& rays,
                                  const MaskN& active) {
  return with_type(Shapes{}, object.shape_type, [&](auto type) {
    using Shape = typename decltype(type)::type;
    return occludes<Shape>(tables.template table<Shape>().records[object.primitive], rays, active);
  });
}

}  // namespace

Hits Accelerator::intersect_unbounded(Ray<FloatN>& rays, const MaskN& active, const RayIdentity* identity) const {
  Hits hits;
  hits.hit = MaskN(false);
  hits.instance = UintN(0u);
  hits.geometry = UintN(RTC_INVALID_GEOMETRY_ID);
  hits.primitive = IntN(0);
  hits.u = hits.v = FloatN(0);
  // They come in the order that decides at equal distances: what lies where the rays end so far comes too late.
  for_each_unbounded(table_, [&](auto type, std::uint32_t primitive, const auto& record) RAYTRACE_INLINE_LAMBDA {
    intersect_object<typename decltype(type)::type>(record, primitive, rays, active,
                                                    {hits, rays.far, rays.far, cutouts_of(identity)});
  });
  return hits;
}

MaskN Accelerator::occluded_unbounded(const Ray<FloatN>& rays, const MaskN& active, const RayIdentity* identity) const {
  MaskN occluded(false);
  const RayIdentity* const cutouts = cutouts_of(identity);
  for_each_unbounded(table_, [&](auto type, std::uint32_t primitive, const auto& record) RAYTRACE_INLINE_LAMBDA {
    using Shape = typename decltype(type)::type;
    if (cutouts == nullptr) [[likely]]
      occluded = occluded | occludes<Shape>(record, rays, active);
    else
      occluded = occluded | (distance_to_cutout<Shape>(record, primitive, rays, active, *cutouts) < infinity<FloatN>());
  });
  return occluded;
}

MaskN Accelerator::intersect_candidates(const DirectionBuffer& buffer, Ray<FloatN>& rays, const MaskN& active,
                                        FloatN& distance, Hits& hits) const {
  const auto reaches = [&](const MaskN& lanes, const DirectionBuffer::Object& object) {
    return any(lanes & (rays.far * rays.far >= FloatN(object.nearest)));
  };
  const RaysFromPoint<FloatN> from_point{buffer.point(), rays.direction, rays.near, rays.far};
  const auto test = [&](const DirectionBuffer::Object& object) {
    with_type(Shapes{}, object.shape_type, [&](auto type) {
      using Shape = typename decltype(type)::type;
      const auto& record = table_.table<Shape>().records[object.primitive];
      if constexpr (TakesRaysFromPoint<Shape>) {
        intersect_object<Shape>(record, object.primitive, from_point, active, {hits, distance, rays.far});
      } else {
        intersect_object<Shape>(record, object.primitive, rays, active, {hits, distance, rays.far});
      }
    });
  };
  const auto fetch = [&](const DirectionBuffer::Object& object) RAYTRACE_INLINE_LAMBDA { fetch_record(object); };
  return for_each_candidate<Way::from_point>(buffer, rays.direction, active, reaches, fetch, test);
}

MaskN Accelerator::occluded_by_candidates(const DirectionBuffer& buffer, const Ray<FloatN>& rays, const MaskN& active,
                                          const MaskN& in_reach, MaskN& occluded) const {
  const FloatN depth = buffer.depth(rays.origin, rays.direction);
  MaskN open = active;
  const auto reaches = [&](const MaskN& lanes, const DirectionBuffer::Object& object) {
    return any(lanes & open & (depth >= FloatN(object.nearest)));
  };
  const auto test = [&](const DirectionBuffer::Object& object) {
    open = open & !is_occluded(table_, object, rays, open);
  };
  const auto fetch = [&](const DirectionBuffer::Object& object) RAYTRACE_INLINE_LAMBDA { fetch_record(object); };
  const auto test_all = [&](const Vec3<FloatN>& direction) RAYTRACE_INLINE_LAMBDA {
    return for_each_candidate<Way::to_point>(buffer, direction, active & in_reach, reaches, fetch, test);
  };
  MaskN left = buffer.infinitely_far() ? test_all(buffer.direction_to_picture(rays.origin)) : test_all(rays.direction);
  if (any(active & !in_reach)) left = left | (active & !in_reach & !buffer.leads_past(rays));
  occluded = occluded | (active & !open);
  return open & left;
}

Hits Accelerator::intersect(Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                            const DirectionBuffer* origin_buffer, const RayIdentity* identity) const {
  // All rays that start where the origin is can be taken.
  MaskN valid_lanes = origin_buffer != nullptr ? active : active & embree_takes(rays);
  // First the shapes without end: what lies behind their hits need not be looked for.
  Hits hits = intersect_unbounded(rays, valid_lanes, identity);
  rays.near = max(rays.near, FloatN(0));
  FloatN distance = rays.far;
  rays.far = select(hits.hit, behind(distance), distance);
  if (origin_buffer != nullptr) valid_lanes = intersect_candidates(*origin_buffer, rays, valid_lanes, distance, hits);
  if (any(valid_lanes)) {
    if (tests_all(coherence, identity))
      few_objects_.intersect(rays, valid_lanes, distance, hits);
    else
      intersect_bvh(rays, valid_lanes, coherence, identity, distance, hits);
  }
  rays.far = distance;
  hits.time = times_of(identity);
  hits.find_first();
  return hits;
}

void Accelerator::intersect_bvh(const Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                                const RayIdentity* identity, FloatN& distance, Hits& hits) const {
  RTCScene scene = embree_scene();
  if (fog_scene_ && identity != nullptr && identity->meets == Meets::boundaries_of_fogs) [[unlikely]]
    scene = fog_scene_.get();
  embree::Query query(coherence == Coherence::coherent);
  alignas(64) embree::RegisterPacket::RayHit packets[embree::packets];
  embree::store_rays(rays, times_of(identity), [&](int i) -> auto& { return packets[i].ray; });
  embree::store(UintN(RTC_INVALID_GEOMETRY_ID), [&](int i) { return packets[i].hit.geomID; });
  embree::store(UintN(RTC_INVALID_GEOMETRY_ID), [&](int i) { return packets[i].hit.instID[0]; });
  embree::store(hits.u, [&](int i) { return packets[i].hit.u; });
  embree::store(hits.v, [&](int i) { return packets[i].hit.v; });
  query.cutouts = cutouts_of(identity);
  distance.store_aligned(query.distance);
  hits.geometry.store_aligned(query.geometry);
  same_bits<UintN>(hits.primitive).store_aligned(query.primitive);
  hits.instance.store_aligned(query.instance);
  if (coherence == Coherence::coherent) {
    const embree::ValidLanes valid(active);
    embree::for_each_packet(
        active, [&](int i) { embree::RegisterPacket::intersect(valid.lanes[i], scene, query, packets[i]); });
  } else {
    embree::for_each_lane(active, [&](int i, int lane) {
      auto& packet = packets[i];
      RTCRayHit single{};
      single.ray = single_ray(packet.ray, lane);
      single.hit.geomID = single.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      single.hit.u = packet.hit.u[lane];
      single.hit.v = packet.hit.v[lane];
      embree::Packet<1>::intersect(nullptr, scene, query, single);
      packet.hit.u[lane] = single.hit.u;
      packet.hit.v[lane] = single.hit.v;
    });
  }
  distance = FloatN::load_aligned(query.distance);
  hits.geometry = UintN::load_aligned(query.geometry);
  hits.primitive = same_bits<IntN>(UintN::load_aligned(query.primitive));
  hits.instance = UintN::load_aligned(query.instance);
  hits.hit = hits.hit | (active & float_mask<FloatN>(hits.geometry != UintN(embree::Query::none)));
  hits.u = embree::load<FloatN>([&](int i) { return packets[i].hit.u; });
  hits.v = embree::load<FloatN>([&](int i) { return packets[i].hit.v; });
}

MaskN Accelerator::occluded(const Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                            const DirectionBuffer* end_buffer, const RayIdentity* identity) const {
  MaskN in_reach(false), takeable = active;  // those in reach can be taken
  if (end_buffer != nullptr) in_reach = end_buffer->in_reach(rays.origin, rays.direction);
  if (any(active & !in_reach)) takeable = active & (in_reach | embree_takes(rays));
  MaskN found = occluded_unbounded(rays, takeable, identity);
  MaskN valid_lanes = takeable & !found;
  if (end_buffer != nullptr) valid_lanes = occluded_by_candidates(*end_buffer, rays, valid_lanes, in_reach, found);
  if (none(valid_lanes)) return found;
  if (tests_all(coherence, identity)) return found | few_objects_.occluded(rays, valid_lanes);

  const RTCScene scene = embree_scene();
  embree::Query query(coherence == Coherence::coherent);
  alignas(64) embree::RegisterPacket::Ray packets[embree::packets];
  const Ray<FloatN> followed{rays.origin, rays.direction, max(rays.near, FloatN(0)), behind(rays.far)};
  embree::store_rays(followed, times_of(identity), [&](int i) -> auto& { return packets[i]; });
  rays.far.store_aligned(query.distance);
  query.cutouts = cutouts_of(identity);
  if (coherence == Coherence::coherent) {
    const embree::ValidLanes valid(valid_lanes);
    embree::for_each_packet(valid_lanes,
                            [&](int i) { embree::RegisterPacket::occluded(valid.lanes[i], scene, query, packets[i]); });
  } else {
    embree::for_each_lane(valid_lanes, [&](int i, int lane) {
      RTCRay single = single_ray(packets[i], lane);
      embree::Packet<1>::occluded(nullptr, scene, query, single);
      packets[i].tfar[lane] = single.tfar;
    });
  }
  return found | (valid_lanes & (embree::load<FloatN>([&](int i) { return packets[i].tfar; }) < FloatN(0)));
}

}  // namespace raytrace
