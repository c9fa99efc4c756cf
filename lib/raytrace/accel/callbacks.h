// Embree's callbacks: one template for every shape and packet size. They decide what a ray hits; Embree finds what it
// may hit.
//
// A shape supplies bounds() and intersect() for F lanes and knows nothing of Embree. intersect and occluded go through
// the same code, but that a shape may leave out what only the distance needs (occludes()). Embree intersects triangles
// itself; its filters then put each hit to Kernel<Triangle>, since Embree's distances differ from processor to
// processor in their last bits, and between packets and single rays.
//
// Of hits at equal distances, the first by geometry and primitive counts, in whatever order Embree visits them: it goes
// on to behind(distance), and Query holds the distance itself.
// https://github.com/RenderKit/embree, doc/src/api/rtcSetGeometryIntersectFunction.md and
// rtcSetGeometryIntersectFilterFunction.md
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "raytrace/accel/cutouts.h"
#include "raytrace/accel/embree.h"
#include "raytrace/accel/primitives.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/scene/geometry_table.h"

namespace raytrace {

/// How far Embree follows a ray that has hit something: behind it by more than the roundings of its boxes, of its
/// triangles' distances and of our spheres' (2^-17), so that it finds all that may lie as near.
template <class F>
RAYTRACE_INLINE F behind(const F& distance) {
  return distance * F(1 + 0x1p-14F);
}

/// Of a hit, or of one for each lane: what decides at equal distances, the first number first.
template <class T>
struct HitIds {
  T instance, geometry, primitive;
};

/// Whether a hit at t, which may be infinite for none, comes before the one at `nearest` whose ids nearest_ids()
/// returns. Where it has none, nearest is where the ray ends.
template <class F, class NearestIds>
RAYTRACE_INLINE Mask<F> comes_first(const F& t, const HitIds<std::uint32_t>& ids, const F& nearest,
                                    const NearestIds& nearest_ids) {
  const Mask<F> nearer = t < nearest, tie = (t == nearest) & (t < infinity<F>());
  if (none(tie)) return nearer;
  const HitIds<Uints<F>> other = nearest_ids();
  // Single shapes count as the world's.
  const Uints<F> instance((ids.instance & InstanceTable::shape_of_world) != 0 ? 0 : ids.instance);
  const Mask<F> is_shape = float_mask<F>(same_bits<Ints<F>>(other.instance) < Ints<F>(0));
  const auto other_instance = same_bits<Uints<F>>(select(is_shape, F(0), same_bits<F>(other.instance)));
  const Uints<F> g(ids.geometry), p(ids.primitive), nothing(embree::Query::none);
  const auto first =
      (instance < other_instance) |
      ((instance == other_instance) & ((g < other.geometry) | ((g == other.geometry) & (p < other.primitive))));
  return nearer | (tie & float_mask<F>(first & (other.geometry != nothing)));
}

namespace detail {

// Embree's packets are arrays of `size` floats for each field. F covers lanes [first, first + lane_count<F>) of them,
// or, where the packet is narrower than F, all of them: `count` says how many there are.

template <class Batch>
RAYTRACE_INLINE Batch load_lanes(const typename Batch::value_type* lanes, int count) {
  constexpr int size = static_cast<int>(Batch::size);
  if (count == 1) return Batch(*lanes);  // most often: a single ray
  if (count >= size) return Batch::load_unaligned(lanes);
  alignas(64) typename Batch::value_type copy[size];
  for (int lane = 0; lane < size; ++lane) copy[lane] = lanes[std::min(lane, count - 1)];
  return Batch::load_aligned(copy);
}

template <class F>
RAYTRACE_INLINE Mask<F> load_mask(const int* valid, int count) {
  if (count == 1) return first_lanes<F>(*valid != 0 ? 1 : 0);
  alignas(64) std::int32_t copy[lane_count<F>] = {};
  if (count >= lane_count<F>) return float_mask<F>(Ints<F>::load_unaligned(valid) != Ints<F>(0));
  std::copy_n(valid, count, copy);
  return float_mask<F>(Ints<F>::load_aligned(copy) != Ints<F>(0));
}

/// Overwrites the lanes of `mask`. Value: floats or unsigned integers of F's lane count.
template <class F, class Value>
RAYTRACE_INLINE void store_lanes(typename Value::value_type* lanes, int count, const Mask<F>& mask,
                                 const Value& value) {
  if (count == 1) {
    if ((bits_of<F>(mask) & 1U) != 0) *lanes = value.get(0);
    return;
  }
  if (count >= lane_count<F>) {
    const F old = std::bit_cast<F>(Value::load_unaligned(lanes));
    std::bit_cast<Value>(select(mask, std::bit_cast<F>(value), old)).store_unaligned(lanes);
    return;
  }
  alignas(64) typename Value::value_type copy[lane_count<F>];
  value.store_aligned(copy);
  const std::uint32_t bits = bits_of<F>(mask);
  for (int lane = 0; lane < count; ++lane)
    if ((bits >> lane & 1) != 0) lanes[lane] = copy[lane];
}

/// In Embree 4, `valid` also carries the answer.
template <class F>
void report_hits(int* valid, int count, const Mask<F>& hit) {
  if constexpr (embree::callback_reports_hits) {
    const std::uint32_t bits = bits_of<F>(hit);
    for (int lane = 0; lane < std::min(count, lane_count<F>); ++lane) valid[lane] = (bits >> lane & 1) != 0 ? -1 : 0;
  }
}

template <class F>
RAYTRACE_INLINE Ray<F> load_rays(RTCRayN* rays, unsigned size, unsigned first, int count) {
  const auto load = [count](const float& lanes) { return load_lanes<F>(&lanes, count); };
  return {{load(RTCRayN_org_x(rays, size, first)), load(RTCRayN_org_y(rays, size, first)),
           load(RTCRayN_org_z(rays, size, first))},
          {load(RTCRayN_dir_x(rays, size, first)), load(RTCRayN_dir_y(rays, size, first)),
           load(RTCRayN_dir_z(rays, size, first))},
          load(RTCRayN_tnear(rays, size, first)),
          load(RTCRayN_tfar(rays, size, first))};
}

/// The rays [first, first + lane_count<F>) of a callback's packet, and what the query keeps of them.
template <class F>
struct CallbackRays {
  int count;
  Mask<F> active;
  embree::Query& nearest;
  unsigned id;  ///< of the first ray
  Ray<F> rays;

  template <class Arguments>
  CallbackRays(const Arguments* arguments, RTCRayN* all, unsigned first)
      : count(static_cast<int>(arguments->N - first)),
        active(load_mask<F>(arguments->valid + first, count)),
        nearest(embree::Query::of(arguments)),
        id(RTCRayN_id(all, arguments->N, first)),
        rays(load_rays<F>(all, arguments->N, first, count)) {}

  F distance() const { return load_lanes<F>(nearest.distance + id, count); }

  /// The distances at which the rays, in those lanes, meet a primitive of opacity. find(rays, lanes, u, v): its hits.
  template <class Find>
  F meet(const Mask<F>& lanes, F& u, F& v, std::uint32_t geometry, std::uint32_t primitive, const Find& find) {
    const F t = find(rays, lanes, u, v);
    if (nearest.cutouts == nullptr) [[likely]]
      return t;
    return without_passed<F>(*nearest.cutouts, id, std::min(count, lane_count<F>),
                             {nearest.current_instance, geometry, primitive, 0}, rays, t, u, v, find);
  }

  /// Keeps the hits at t, in the lanes of the mask, that come before those so far. The result: their lanes.
  Mask<F> keep(const Mask<F>& mask, const F& t, std::uint32_t geometry, std::uint32_t primitive) {
    const std::uint32_t instance = nearest.current_instance;
    const Mask<F> kept = mask & comes_first<F>(t, {instance, geometry, primitive}, distance(), [&] {
                           return HitIds<Uints<F>>{load_lanes<Uints<F>>(nearest.instance + id, count),
                                                   load_lanes<Uints<F>>(nearest.geometry + id, count),
                                                   load_lanes<Uints<F>>(nearest.primitive + id, count)};
                         });
    if (any(kept)) {
      store_lanes<F>(nearest.distance + id, count, kept, t);
      store_lanes<F>(nearest.geometry + id, count, kept, Uints<F>(geometry));
      store_lanes<F>(nearest.primitive + id, count, kept, Uints<F>(primitive));
      store_lanes<F>(nearest.instance + id, count, kept, Uints<F>(instance));
    }
    return kept;
  }
};

/// Objects: ShapeObjects or CurvePieces.
template <class Objects>
struct Intersect {
  using Arguments = RTCIntersectFunctionNArguments;

  template <class F>
  static void call(const Arguments* arguments, unsigned first) {
    RTCRayN* const all = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
    CallbackRays<F> packet(arguments, all, first);
    F u(0), v(0);
    const F t = packet.meet(packet.active, u, v, arguments->geomID, arguments->primID,
                            [&](const Ray<F>& rays, const Mask<F>& active, F& u_there, F&) RAYTRACE_INLINE_LAMBDA {
                              return Objects::template intersect<F>(arguments->geometryUserPtr, arguments->primID, rays,
                                                                    active, packet.nearest.current_material, u_there);
                            });
    const Mask<F> hit = packet.keep(t < infinity<F>(), t, arguments->geomID, arguments->primID);
    if (any(hit)) {
      store_lanes<F>(&RTCRayN_tfar(all, arguments->N, first), packet.count, hit, behind(t));
      if constexpr (requires { requires Objects::has_u; })
        store_lanes<F>(&RTCHitN_u(RTCRayHitN_HitN(arguments->rayhit, arguments->N), arguments->N, first), packet.count,
                       hit, u);
    }
    report_hits<F>(arguments->valid + first, packet.count, hit);
  }
};

template <class Objects>
struct Occlude {
  using Arguments = RTCOccludedFunctionNArguments;

  template <class F>
  static void call(const Arguments* arguments, unsigned first) {
    CallbackRays<F> packet(arguments, arguments->ray, first);
    packet.rays.far = packet.distance();
    const std::int32_t material = packet.nearest.current_material;
    Mask<F> hit(false);
    if (packet.nearest.cutouts == nullptr) [[likely]] {
      hit = Objects::template occludes<F>(arguments->geometryUserPtr, arguments->primID, packet.rays, packet.active,
                                          material);
    } else {
      F u(0), v(0);
      hit = packet.meet(packet.active, u, v, arguments->geomID, arguments->primID,
                        [&](const Ray<F>& rays, const Mask<F>& active, F& u_there, F&) {
                          return Objects::template intersect<F>(arguments->geometryUserPtr, arguments->primID, rays,
                                                                active, material, u_there);
                        }) < infinity<F>();
    }
    if (any(hit)) store_lanes<F>(&RTCRayN_tfar(arguments->ray, arguments->N, first), packet.count, hit, -infinity<F>());
    report_hits<F>(arguments->valid + first, packet.count, hit);
  }
};

/// Calls f(lanes, primitive) for each triangle that lanes of the packet may hit, most of all there is one; f returns in
/// which of them it is right. `valid` becomes those.
template <class F, class Function>
RAYTRACE_INLINE void filter_packet(const RTCFilterFunctionNArguments* arguments, unsigned first,
                                   const CallbackRays<F>& packet, const Function& f) {
  const Uints<F> primitives = load_lanes<Uints<F>>(&RTCHitN_primID(arguments->hit, arguments->N, first), packet.count);
  Mask<F> left = packet.active, right(false);
  while (any(left)) {
    const std::uint32_t primitive = primitives.get(static_cast<std::size_t>(std::countr_zero(bits_of<F>(left))));
    const Mask<F> lanes = left & float_mask<F>(primitives == Uints<F>(primitive));
    right = right | f(lanes, primitive);
    left = left & !lanes;
  }
  const std::uint32_t bits = bits_of<F>(right);
  for (int lane = 0; lane < std::min(packet.count, lane_count<F>); ++lane)
    if ((bits >> lane & 1) == 0) arguments->valid[first + static_cast<unsigned>(lane)] = 0;
}

/// How rays hit one of a geometry's triangles, for CallbackRays::meet().
template <class Triangles>
RAYTRACE_INLINE auto find(const RTCFilterFunctionNArguments* arguments, std::uint32_t primitive) {
  return [table = arguments->geometryUserPtr, primitive]<class F>(const Ray<F>& rays, const Mask<F>& lanes, F& u, F& v)
             RAYTRACE_INLINE_LAMBDA { return Triangles::template intersect<F>(table, primitive, rays, lanes, u, v); };
}

/// Embree has set tfar to its own distance. It takes what is written there, and u and v, as the hit's.
template <class Triangles>
struct FilterIntersect {
  using Arguments = RTCFilterFunctionNArguments;

  template <class F>
  static void call(const Arguments* arguments, unsigned first) {
    CallbackRays<F> packet(arguments, arguments->ray, first);
    packet.rays.far = infinity<F>();
    filter_packet<F>(arguments, first, packet, [&](const Mask<F>& lanes, std::uint32_t primitive) {
      F u(0), v(0);
      const unsigned geometry = RTCHitN_geomID(arguments->hit, arguments->N, first);
      const F t = packet.meet(lanes, u, v, geometry, primitive, find<Triangles>(arguments, primitive));
      const Mask<F> hit = packet.keep(t < infinity<F>(), t, geometry, primitive);
      if (none(hit)) return hit;
      store_lanes<F>(&RTCRayN_tfar(arguments->ray, arguments->N, first), packet.count, hit, behind(t));
      store_lanes<F>(&RTCHitN_u(arguments->hit, arguments->N, first), packet.count, hit, u);
      store_lanes<F>(&RTCHitN_v(arguments->hit, arguments->N, first), packet.count, hit, v);
      return hit;
    });
  }
};

template <class Triangles>
struct FilterOcclude {
  using Arguments = RTCFilterFunctionNArguments;

  template <class F>
  static void call(const Arguments* arguments, unsigned first) {
    CallbackRays<F> packet(arguments, arguments->ray, first);
    packet.rays.far = packet.distance();
    filter_packet<F>(arguments, first, packet, [&](const Mask<F>& lanes, std::uint32_t primitive) {
      F u(0), v(0);
      return packet.meet(lanes, u, v, RTCHitN_geomID(arguments->hit, arguments->N, first), primitive,
                         find<Triangles>(arguments, primitive)) < infinity<F>();
    });
  }
};

/// As Embree calls it: packets by as many lanes as they have, single rays by the fewest there are.
template <class Callback>
void callback(const typename Callback::Arguments* arguments) {
  const auto call = [arguments]<class F>(std::type_identity<F>) {
    for (unsigned first = 0; first < arguments->N; first += static_cast<unsigned>(lane_count<F>))
      Callback::template call<F>(arguments, first);
  };
  switch (arguments->N) {
    case 16:
      return call(std::type_identity<FloatLanes<16>>{});
    case 8:
      return call(std::type_identity<FloatLanes<8>>{});
    default:
      return call(std::type_identity<FloatLanes<4>>{});
  }
}

inline void set_bounds(RTCBounds& box, const Bounds& bounds) {
  box.lower_x = bounds.lower.x;
  box.lower_y = bounds.lower.y;
  box.lower_z = bounds.lower.z;
  box.upper_x = bounds.upper.x;
  box.upper_y = bounds.upper.y;
  box.upper_z = bounds.upper.z;
}

/// Objects with empty bounds stay out of the BVH.
template <class Shape>
void bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  const auto& table = *static_cast<const ShapeTable<Shape>*>(arguments->geometryUserPtr);
  const unsigned primitive = arguments->primID;
  set_bounds(*arguments->bounds_o,
             table.is_instanced(primitive) ? empty_bounds : Kernel<Shape>::bounds(table.records[primitive]));
}

/// Points behind which there is no piece stay out of the BVH.
inline void curve_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& curves = *static_cast<const CurveTable*>(arguments->geometryUserPtr);
  const unsigned piece = arguments->primID;
  set_bounds(*arguments->bounds_o, curves.has_piece(piece) ? curves.piece_bounds(piece) : empty_bounds);
}

}  // namespace detail

template <class Triangles>
void set_filters(RTCGeometry geometry, const void* user_pointer) {
  // Embree hands it to the callbacks, which only read.
  rtcSetGeometryUserData(geometry, const_cast<void*>(user_pointer));
  rtcSetGeometryIntersectFilterFunction(geometry, &detail::callback<detail::FilterIntersect<Triangles>>);
  rtcSetGeometryOccludedFilterFunction(geometry, &detail::callback<detail::FilterOcclude<Triangles>>);
}

/// The callbacks of a mesh, which must outlive the geometry.
inline void set_callbacks(RTCGeometry geometry, const MeshTable& mesh) {
  set_filters<detail::MeshFaces>(geometry, &mesh);
}

/// Those of curves, which must outlive the geometry.
inline void set_callbacks(RTCGeometry geometry, const CurveTable& curves) {
  rtcSetGeometryUserData(geometry, const_cast<CurveTable*>(&curves));
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(curves.point_count()));
  rtcSetGeometryBoundsFunction(geometry, &detail::curve_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &detail::callback<detail::Intersect<detail::CurvePieces>>);
  rtcSetGeometryOccludedFunction(geometry, &detail::callback<detail::Occlude<detail::CurvePieces>>);
}

/// The shape's callbacks, for a geometry of its table's objects, which must outlive it.
template <class Shape>
void set_callbacks(RTCGeometry geometry, const ShapeTable<Shape>& table) {
  if constexpr (EmbreeTriangle<Shape>) {
    set_filters<detail::RecordTriangles<Shape>>(geometry, &table);
  } else {
    rtcSetGeometryUserData(geometry, const_cast<ShapeTable<Shape>*>(&table));
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(table.records.size()));
    rtcSetGeometryBoundsFunction(geometry, &detail::bounds_callback<Shape>, nullptr);
    rtcSetGeometryIntersectFunction(geometry, &detail::callback<detail::Intersect<detail::ShapeObjects<Shape>>>);
    rtcSetGeometryOccludedFunction(geometry, &detail::callback<detail::Occlude<detail::ShapeObjects<Shape>>>);
  }
}

}  // namespace raytrace
