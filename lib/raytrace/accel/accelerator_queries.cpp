// Accelerator's queries; what they ask is built in accelerator.cpp.
#include <bit>

#include "raytrace/accel/accelerator.h"
#include "raytrace/accel/embree_packets.h"
#include "raytrace/accel/for_each_candidate.h"
#include "raytrace/math/gather.h"

namespace raytrace {

namespace {

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
  ray.mask = rays.mask[lane];
  return ray;
}

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

RAYTRACE_INLINE void find_first(Hits& hits) {
  const std::uint32_t lanes = bits_of<FloatN>(hits.hit);
  if (lanes == 0) return;
  const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
  hits.first_geometry = hits.geometry.get(lane);
  hits.first_primitive = hits.primitive.get(lane);
  hits.one_geometry = none(hits.hit & float_mask<FloatN>(hits.geometry != UintN(hits.first_geometry)));
  hits.one_primitive =
      hits.one_geometry && none(hits.hit & float_mask<FloatN>(hits.primitive != IntN(hits.first_primitive)));
}

/// Shapes that take rays from a point as such.
template <class Shape>
concept TakesRaysFromPoint =
    requires(typename ShapeTable<Shape>::Record record, RaysFromPoint<FloatN> rays, MaskN active, FloatN u) {
      Kernel<Shape>::template intersect<FloatN>(record, rays, active);
    } || requires(typename ShapeTable<Shape>::Record record, RaysFromPoint<FloatN> rays, MaskN active, FloatN u) {
      Kernel<Shape>::template intersect<FloatN>(record, rays, active, u, u);
    };

/// Ends the rays where they meet an object. far: where they end, whatever Rays is.
template <class Shape, class Rays>
RAYTRACE_INLINE void meet(const typename ShapeTable<Shape>::Record& record, std::uint32_t primitive, const Rays& rays,
                          FloatN& far, const MaskN& active, Hits& hits) {
  FloatN distance, u(0), v(0);  // a triangle that no ray meets leaves u and v as they are
  if constexpr (EmbreeTriangle<Shape>) {
    distance = Kernel<Shape>::template intersect<FloatN>(record, rays, active, u, v);
  } else {
    distance = Kernel<Shape>::template intersect<FloatN>(record, rays, active);
  }
  const MaskN hit = distance < infinity<FloatN>();  // in float it may be the same as the one before
  if (none(hit)) return;
  far = select(hit, distance, far);
  hits.hit = hits.hit | hit;
  hits.geometry = select_lanes(hit, UintN(static_cast<std::uint32_t>(index_of<Shape>(Shapes{}))), hits.geometry);
  hits.primitive = select_lanes(hit, IntN(static_cast<std::int32_t>(primitive)), hits.primitive);
  if constexpr (EmbreeTriangle<Shape>) {
    hits.u = select(hit, u, hits.u);
    hits.v = select(hit, v, hits.v);
  }
}

/// Whether the object lies on the rays.
template <class Tables>
RAYTRACE_INLINE MaskN is_occluded(const Tables& tables, const DirectionBuffer::Object& object, const Ray<FloatN>& rays,
                                  const MaskN& active) {
  return with_type(Shapes{}, object.shape_type, [&](auto type) {
    using Shape = typename decltype(type)::type;
    return occludes<Shape>(tables.template table<Shape>().records[object.primitive], rays, active);
  });
}

/// Shapes whose objects are few and large: their surface() takes one, so that it can be of the plain numbers.
template <class Shape>
concept SurfaceOfOne = requires(typename ShapeTable<Shape>::Record record, Ray<FloatN> rays, FloatN distance) {
  Kernel<Shape>::surface(record, rays, distance);
};

/// With the normal on the side that the rays come from.
RAYTRACE_INLINE SurfacePoint<FloatN> facing(const SurfacePoint<FloatN>& point, const Ray<FloatN>& rays) {
  return {point.position, select(dot(point.normal, rays.direction) > FloatN(0), -point.normal, point.normal),
          point.error};
}

/// The surfaces of one shape, under the wide type of its table's precision.
template <class Shape>
SurfacePoint<FloatN> surface_of(const ShapeTable<Shape>& table, const LaneIndices& primitive, const Ray<FloatN>& rays,
                                const Hits& hits) {
  if constexpr (SurfaceOfOne<Shape>) {
    SurfacePoint<FloatN> points =
        facing(Kernel<Shape>::surface(table.records[primitive.first()], rays, rays.far), rays);
    if (primitive.all_same()) return points;
    MaskN left = float_mask<FloatN>(primitive.lanes() != IntN(static_cast<std::int32_t>(primitive.first())));
    while (any(left)) {
      const std::int32_t next =
          primitive.lanes().get(static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(left))));
      const MaskN here = left & float_mask<FloatN>(primitive.lanes() == IntN(next));
      const auto& record = table.records[static_cast<std::size_t>(next)];
      points = select(here, facing(Kernel<Shape>::surface(record, rays, rays.far), rays), points);
      left = left & !here;
    }
    return points;
  } else {
    constexpr bool in_float =
        std::is_same_v<typename ShapeTable<Shape>::Record, typename Kernel<Shape>::template Record<float>>;
    using Wide = std::conditional_t<in_float, FloatN, Doubles<FloatN>>;
    const auto records = gather_records<Kernel<Shape>::template Record, Wide>(table.records.data(), primitive);
    if constexpr (EmbreeTriangle<Shape>) {
      return facing(Kernel<Shape>::template surface<FloatN>(records, hits.u, hits.v), rays);
    } else {
      return facing(Kernel<Shape>::template surface<FloatN>(records, rays, rays.far), rays);
    }
  }
}

}  // namespace

Hits Accelerator::intersect_unbounded(Ray<FloatN>& rays, const MaskN& active) const {
  Hits hits;
  hits.hit = MaskN(false);
  hits.instance = UintN(Hits::no_instance);
  hits.geometry = UintN(RTC_INVALID_GEOMETRY_ID);
  hits.primitive = IntN(0);
  hits.u = hits.v = FloatN(0);
  for_each_unbounded(table_, [&](auto type, std::uint32_t primitive, const auto& record) RAYTRACE_INLINE_LAMBDA {
    meet<typename decltype(type)::type>(record, primitive, rays, rays.far, active, hits);
  });
  return hits;
}

MaskN Accelerator::occluded_unbounded(const Ray<FloatN>& rays, const MaskN& active) const {
  MaskN occluded(false);
  for_each_unbounded(table_, [&](auto type, std::uint32_t, const auto& record) RAYTRACE_INLINE_LAMBDA {
    using Shape = typename decltype(type)::type;
    occluded = occluded | occludes<Shape>(record, rays, active);
  });
  return occluded;
}

MaskN Accelerator::intersect_candidates(const DirectionBuffer& seen, Ray<FloatN>& rays, const MaskN& active,
                                        Hits& hits) const {
  const auto reaches = [&](const MaskN& lanes, const DirectionBuffer::Object& object) {
    return any(lanes & (rays.far * rays.far >= FloatN(object.nearest)));
  };
  const RaysFromPoint<FloatN> from_point{seen.point(), rays.direction, rays.near, rays.far};
  const auto test = [&](const DirectionBuffer::Object& object) {
    with_type(Shapes{}, object.shape_type, [&](auto type) {
      using Shape = typename decltype(type)::type;
      const auto& record = table_.table<Shape>().records[object.primitive];
      if constexpr (TakesRaysFromPoint<Shape>) {
        meet<Shape>(record, object.primitive, from_point, rays.far, active, hits);
      } else {
        meet<Shape>(record, object.primitive, rays, rays.far, active, hits);
      }
    });
  };
  const auto fetch = [&](const DirectionBuffer::Object& object) RAYTRACE_INLINE_LAMBDA { fetch_record(object); };
  return for_each_candidate<Way::from_point>(seen, rays.direction, active, reaches, fetch, test);
}

MaskN Accelerator::occluded_by_candidates(const DirectionBuffer& seen, const Ray<FloatN>& rays, const MaskN& active,
                                          const MaskN& in_reach, MaskN& occluded) const {
  const FloatN depth = seen.depth(rays.origin, rays.direction);
  MaskN open = active;
  const auto reaches = [&](const MaskN& lanes, const DirectionBuffer::Object& object) {
    return any(lanes & open & (depth >= FloatN(object.nearest)));
  };
  const auto test = [&](const DirectionBuffer::Object& object) {
    open = open & !is_occluded(table_, object, rays, open);
  };
  const auto fetch = [&](const DirectionBuffer::Object& object) RAYTRACE_INLINE_LAMBDA { fetch_record(object); };
  const auto test_all = [&](const Vec3<FloatN>& direction) RAYTRACE_INLINE_LAMBDA {
    return for_each_candidate<Way::to_point>(seen, direction, active & in_reach, reaches, fetch, test);
  };
  MaskN left = seen.infinitely_far() ? test_all(seen.direction_to_picture(rays.origin)) : test_all(rays.direction);
  if (any(active & !in_reach)) left = left | (active & !in_reach & !seen.leads_past(rays));
  occluded = occluded | (active & !open);
  return open & left;
}

Hits Accelerator::intersect(Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                            const DirectionBuffer* origin_buffer) const {
  // All rays that start where the origin is can be taken.
  MaskN valid_lanes = origin_buffer != nullptr ? active : active & embree_takes(rays);
  // First the shapes without end: what lies behind their hits need not be looked for.
  Hits hits = intersect_unbounded(rays, valid_lanes);
  if (origin_buffer != nullptr) {
    valid_lanes = intersect_candidates(*origin_buffer, rays, valid_lanes, hits);
    find_first(hits);
  }
  if (none(valid_lanes)) return hits;

  const RTCScene scene = embree_scene();
  embree::Query query(coherence == Coherence::coherent);
  alignas(64) embree::RegisterPacket::RayHit packets[embree::packets];
  embree::store_rays(rays, [&](int i) -> auto& { return packets[i].ray; });
  embree::store(UintN(RTC_INVALID_GEOMETRY_ID), [&](int i) { return packets[i].hit.geomID; });
  embree::store(UintN(RTC_INVALID_GEOMETRY_ID), [&](int i) { return packets[i].hit.instID[0]; });
  if (coherence == Coherence::coherent) {
    const embree::ValidLanes valid(valid_lanes);
    embree::for_each_packet(
        valid_lanes, [&](int i) { embree::RegisterPacket::intersect(valid.lanes[i], scene, query, packets[i]); });
  } else {
    embree::for_each_lane(valid_lanes, [&](int i, int lane) {
      auto& packet = packets[i];
      RTCRayHit single{};
      single.ray = single_ray(packet.ray, lane);
      single.hit.geomID = single.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      embree::intersect1(scene, query, single);
      packet.ray.tfar[lane] = single.ray.tfar;
      packet.hit.u[lane] = single.hit.u;
      packet.hit.v[lane] = single.hit.v;
      packet.hit.primID[lane] = single.hit.primID;
      packet.hit.geomID[lane] = single.hit.geomID;
    });
  }
  const UintN geometry = embree::load<UintN>([&](int i) { return packets[i].hit.geomID; });
  const MaskN in_bvh = valid_lanes & float_mask<FloatN>(geometry != UintN(RTC_INVALID_GEOMETRY_ID));
  hits.hit = hits.hit | in_bvh;
  hits.geometry = select_lanes(in_bvh, geometry, hits.geometry);
  const UintN primitive = embree::load<UintN>([&](int i) { return packets[i].hit.primID; });
  hits.primitive = select_lanes(in_bvh, same_bits<IntN>(primitive), hits.primitive);
  rays.far = embree::load<FloatN>([&](int i) { return packets[i].ray.tfar; });
  hits.u = select(in_bvh, embree::load<FloatN>([&](int i) { return packets[i].hit.u; }), hits.u);
  hits.v = select(in_bvh, embree::load<FloatN>([&](int i) { return packets[i].hit.v; }), hits.v);
  find_first(hits);
  return hits;
}

MaskN Accelerator::occluded(const Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                            const DirectionBuffer* end_buffer) const {
  MaskN in_reach(false), takeable = active;  // those in reach can be taken
  if (end_buffer != nullptr) in_reach = end_buffer->in_reach(rays.origin, rays.direction);
  if (any(active & !in_reach)) takeable = active & (in_reach | embree_takes(rays));
  MaskN found = occluded_unbounded(rays, takeable);
  MaskN valid_lanes = takeable & !found;
  if (end_buffer != nullptr) valid_lanes = occluded_by_candidates(*end_buffer, rays, valid_lanes, in_reach, found);
  if (none(valid_lanes)) return found;

  const RTCScene scene = embree_scene();
  embree::Query query(coherence == Coherence::coherent);
  alignas(64) embree::RegisterPacket::Ray packets[embree::packets];
  embree::store_rays(rays, [&](int i) -> auto& { return packets[i]; });
  if (coherence == Coherence::coherent) {
    const embree::ValidLanes valid(valid_lanes);
    embree::for_each_packet(valid_lanes,
                            [&](int i) { embree::RegisterPacket::occluded(valid.lanes[i], scene, query, packets[i]); });
  } else {
    embree::for_each_lane(valid_lanes, [&](int i, int lane) {
      RTCRay single = single_ray(packets[i], lane);
      embree::occluded1(scene, query, single);
      packets[i].tfar[lane] = single.tfar;
    });
  }
  return found | (valid_lanes & (embree::load<FloatN>([&](int i) { return packets[i].tfar; }) < FloatN(0)));
}

SurfaceInteraction<FloatN> Accelerator::surface(const Ray<FloatN>& rays, const Hits& hits) const {
  const auto points_of = [&](std::uint32_t geometry, const LaneIndices& primitive) {
    return with_type(Shapes{}, table_.geometry(geometry).shape_type, [&]<class Shape>(std::type_identity<Shape>) {
      return surface_of<Shape>(table_.table<Shape>(), primitive, rays, hits);
    });
  };
  const auto interaction = [&](const SurfacePoint<FloatN>& point) {
    return SurfaceInteraction<FloatN>{point.position, point.normal, point.normal, -rays.direction, point.error};
  };
  if (hits.one_primitive) return interaction(points_of(hits.first_geometry, LaneIndices(hits.first_primitive)));
  SurfacePoint<FloatN> result{};
  for (MaskN left = hits.hit; any(left);) {
    const auto first = static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(left)));
    const std::uint32_t geometry = hits.geometry.get(first);
    const MaskN here = left & float_mask<FloatN>(hits.geometry == UintN(geometry));
    left = left & !here;
    // The other lanes follow the first of these, so that they read a record that exists, and no further ones.
    const IntN primitive = select_lanes(here, hits.primitive, IntN(hits.primitive.get(first)));
    result = select(here, points_of(geometry, primitive), result);
  }
  return interaction(result);
}

}  // namespace raytrace
