// Embree's callbacks for the shapes that we intersect ourselves: one template for every shape and packet size.
//
// A shape supplies bounds() and intersect() for F lanes and knows nothing of Embree. intersect and occluded go through
// the same code, but that a shape may leave out what only the distance needs (occludes()).
// https://github.com/RenderKit/embree, doc/src/api/rtcSetGeometryIntersectFunction.md
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "raytrace/accel/embree.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/scene/geometry_table.h"

namespace raytrace {

/// Shapes whose records are Embree's triangles.
template <class Shape>
concept EmbreeTriangle = requires { &Kernel<Shape>::template Record<float>::vertex1; };

/// Shapes without end: every ray is tested against them, and they stay out of the BVH. There all boxes on the way to
/// them would be without end.
template <class Shape>
concept UnboundedShape = !requires { &Kernel<Shape>::bounds; };

/// All others: they bring their own intersection, and bounds for a BVH to keep them in.
template <class Shape>
concept UserGeometry = !EmbreeTriangle<Shape> && !UnboundedShape<Shape>;

/// Whether the object lies on the rays, in the lanes of `active`. Kernel::occludes(), where there is one, need not find
/// out where.
template <class Shape, class Record, class F>
RAYTRACE_INLINE Mask<F> occludes(const Record& record, const Ray<F>& ray, const Mask<F>& active) {
  if constexpr (requires { Kernel<Shape>::template occludes<F>(record, ray, active); }) {
    return Kernel<Shape>::template occludes<F>(record, ray, active);
  } else if constexpr (EmbreeTriangle<Shape>) {
    F u, v;
    return Kernel<Shape>::template intersect<F>(record, ray, active, u, v) < infinity<F>();
  } else {
    return Kernel<Shape>::template intersect<F>(record, ray, active) < infinity<F>();
  }
}

namespace detail {

// Embree's packets are arrays of `size` floats for each field. F covers lanes [first, first + lane_count<F>) of them,
// or, where the packet is narrower than F, all of them: `count` says how many there are.

template <class F>
RAYTRACE_INLINE F load_lanes(const float* lanes, int count) {
  if (count >= lane_count<F>) return F::load_unaligned(lanes);
  alignas(64) float copy[lane_count<F>];
  for (int lane = 0; lane < lane_count<F>; ++lane) copy[lane] = lanes[std::min(lane, count - 1)];
  return F::load_aligned(copy);
}

template <class F>
RAYTRACE_INLINE Mask<F> load_mask(const int* valid, int count) {
  alignas(64) std::int32_t copy[lane_count<F>] = {};
  if (count >= lane_count<F>) return float_mask<F>(Ints<F>::load_unaligned(valid) != Ints<F>(0));
  std::copy_n(valid, count, copy);
  return float_mask<F>(Ints<F>::load_aligned(copy) != Ints<F>(0));
}

/// Overwrites the lanes of `mask`. Value: floats or unsigned integers of F's lane count.
template <class F, class Value>
RAYTRACE_INLINE void store_lanes(typename Value::value_type* lanes, int count, const Mask<F>& mask,
                                 const Value& value) {
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

template <class Shape, class F>
void intersect_packet(const RTCIntersectFunctionNArguments* arguments) {
  const unsigned size = arguments->N;
  const auto& record =
      static_cast<const typename ShapeTable<Shape>::Record*>(arguments->geometryUserPtr)[arguments->primID];
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, size);
  RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, size);
  for (unsigned first = 0; first < size; first += static_cast<unsigned>(lane_count<F>)) {
    const int count = static_cast<int>(size - first);
    const Mask<F> active = load_mask<F>(arguments->valid + first, count);
    const F t = Kernel<Shape>::template intersect<F>(record, load_rays<F>(rays, size, first, count), active);
    const Mask<F> hit = t < infinity<F>();
    if (any(hit)) {
      store_lanes<F>(&RTCRayN_tfar(rays, size, first), count, hit, t);
      store_lanes<F>(&RTCHitN_primID(hits, size, first), count, hit, Uints<F>(arguments->primID));
      store_lanes<F>(&RTCHitN_geomID(hits, size, first), count, hit, Uints<F>(arguments->geomID));
    }
    report_hits<F>(arguments->valid + first, count, hit);
  }
}

template <class Shape, class F>
void occluded_packet(const RTCOccludedFunctionNArguments* arguments) {
  const unsigned size = arguments->N;
  const auto& record =
      static_cast<const typename ShapeTable<Shape>::Record*>(arguments->geometryUserPtr)[arguments->primID];
  for (unsigned first = 0; first < size; first += static_cast<unsigned>(lane_count<F>)) {
    const int count = static_cast<int>(size - first);
    const Mask<F> active = load_mask<F>(arguments->valid + first, count);
    const Mask<F> hit = occludes<Shape>(record, load_rays<F>(arguments->ray, size, first, count), active);
    if (any(hit)) store_lanes<F>(&RTCRayN_tfar(arguments->ray, size, first), count, hit, -infinity<F>());
    report_hits<F>(arguments->valid + first, count, hit);
  }
}

template <class Shape>
void bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  const auto* records = static_cast<const typename ShapeTable<Shape>::Record*>(arguments->geometryUserPtr);
  const Bounds bounds = Kernel<Shape>::bounds(records[arguments->primID]);
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = bounds.lower.x;
  box.lower_y = bounds.lower.y;
  box.lower_z = bounds.lower.z;
  box.upper_x = bounds.upper.x;
  box.upper_y = bounds.upper.y;
  box.upper_z = bounds.upper.z;
}

// Each packet size by as many lanes as it has; single rays by the fewest there are.

template <class Shape>
void intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  switch (arguments->N) {
    case 16:
      return intersect_packet<Shape, FloatLanes<16>>(arguments);
    case 8:
      return intersect_packet<Shape, FloatLanes<8>>(arguments);
    default:
      return intersect_packet<Shape, FloatLanes<4>>(arguments);
  }
}

template <class Shape>
void occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  switch (arguments->N) {
    case 16:
      return occluded_packet<Shape, FloatLanes<16>>(arguments);
    case 8:
      return occluded_packet<Shape, FloatLanes<8>>(arguments);
    default:
      return occluded_packet<Shape, FloatLanes<4>>(arguments);
  }
}

}  // namespace detail

/// An Embree user geometry of these objects, which must outlive it.
template <UserGeometry Shape>
embree::Geometry make_user_geometry(RTCDevice device, std::span<const typename ShapeTable<Shape>::Record> records) {
  embree::Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(records.size()));
  // Embree hands it to the callbacks, which only read.
  rtcSetGeometryUserData(geometry.get(), const_cast<typename ShapeTable<Shape>::Record*>(records.data()));
  rtcSetGeometryBoundsFunction(geometry.get(), &detail::bounds_callback<Shape>, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), &detail::intersect_callback<Shape>);
  rtcSetGeometryOccludedFunction(geometry.get(), &detail::occluded_callback<Shape>);
  return geometry;
}

}  // namespace raytrace
