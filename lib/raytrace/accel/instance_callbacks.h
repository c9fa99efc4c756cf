// Embree's callbacks of instances: one user geometry has all of them, a primitive each.
//
// They transform the rays by our own arithmetic, which is the same for packets and single rays, and put them to the
// group's own scene, or to the callback of a single shape. So a million instances take what their matrices and boxes
// take, groups may be of any kind in Embree 3 and 4, and equal distances are settled as everywhere (callbacks.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "raytrace/accel/callbacks.h"
#include "raytrace/accel/embree.h"
#include "raytrace/scene/instance_table.h"

namespace raytrace {

/// What the callbacks of instances need.
struct InstanceCallbacks {
  /// A shape's in a group or in the world.
  struct Shape {
    void* table = nullptr;
    RTCIntersectFunctionN intersect = nullptr;
    RTCOccludedFunctionN occluded = nullptr;
  };
  using Shapes = std::array<Shape, raytrace::Shapes::size>;

  const InstanceTable* instances = nullptr;
  std::vector<RTCScene> groups;      ///< their scenes
  std::vector<Shapes> group_shapes;  ///< of each of them
  Shapes world_shapes;

  const Shape& shape(const InstanceTarget& target) const {
    const Shapes& shapes = target.group < 0 ? world_shapes : group_shapes[static_cast<std::size_t>(target.group)];
    return shapes[target.shape_type];
  }
};

namespace detail {

/// Transforms the `size` rays of a packet in which Embree keeps them; those that it does not take become invalid.
template <int size>
void transform_rays(const AffineRecord<float>& object_from_world, RTCRayN* rays, int* valid) {
  using F = FloatLanes<size == 1 ? 4 : size>;
  constexpr auto n = static_cast<unsigned>(size);
  const auto load = [](const float& lanes) { return load_lanes<F>(&lanes, size); };
  const Vec3<F> origin = apply_point(
      object_from_world,
      Vec3<F>(load(RTCRayN_org_x(rays, n, 0)), load(RTCRayN_org_y(rays, n, 0)), load(RTCRayN_org_z(rays, n, 0))));
  const Vec3<F> direction = apply_vector(
      object_from_world,
      Vec3<F>(load(RTCRayN_dir_x(rays, n, 0)), load(RTCRayN_dir_y(rays, n, 0)), load(RTCRayN_dir_z(rays, n, 0))));
  const auto extent = [](const Vec3<F>& v) { return abs(v.x) + abs(v.y) + abs(v.z); };
  const F of_direction = extent(direction);
  const Mask<F> taken = (extent(origin) + of_direction < F(1.8e18F)) & (of_direction > F(1e-18F));
  const std::uint32_t bits = bits_of<F>(taken);
  for (int lane = 0; lane < size; ++lane)
    if ((bits >> lane & 1) == 0) valid[lane] = 0;
  const auto store = [&](float& lanes, const F& values) { store_lanes<F, F>(&lanes, size, taken, values); };
  store(RTCRayN_org_x(rays, n, 0), origin.x);
  store(RTCRayN_org_y(rays, n, 0), origin.y);
  store(RTCRayN_org_z(rays, n, 0), origin.z);
  store(RTCRayN_dir_x(rays, n, 0), direction.x);
  store(RTCRayN_dir_y(rays, n, 0), direction.y);
  store(RTCRayN_dir_z(rays, n, 0), direction.z);
}

/// What is instanced, as the rays of a query that is under way see it: its callbacks keep their hits under the
/// instance's number.
class InInstance {
 public:
  InInstance(embree::NearestHits& nearest, std::uint32_t number) : nearest_(nearest) {
    nearest.current_instance = number;
  }
  ~InInstance() { nearest_.current_instance = 0; }
  InInstance(const InInstance&) = delete;
  InInstance& operator=(const InInstance&) = delete;

 private:
  embree::NearestHits& nearest_;
};

template <int size>
void intersect_instance(const RTCIntersectFunctionNArguments* arguments) {
  const auto& callbacks = *static_cast<const InstanceCallbacks*>(arguments->geometryUserPtr);
  auto& nearest = *reinterpret_cast<embree::NearestHits*>(arguments->context);
  const InstanceTarget& target = callbacks.instances->target(arguments->primID);
  typename embree::AnyPacket<size>::RayHit packet;
  std::memcpy(&packet, arguments->rayhit, sizeof packet);
  alignas(64) int valid[size];
  std::copy_n(arguments->valid, size, valid);
  auto* const rays = reinterpret_cast<RTCRayN*>(&packet);
  transform_rays<size>(callbacks.instances->object_from_world(arguments->primID), rays, valid);
  const std::uint32_t number = callbacks.instances->number(arguments->primID);
  {
    const InInstance here(nearest, number);
    if (target.is_shape) {
      const InstanceCallbacks::Shape& shape = callbacks.shape(target);
      RTCIntersectFunctionNArguments inner = *arguments;
      inner.valid = valid;
      inner.geometryUserPtr = shape.table;
      inner.geomID = target.shape_type;
      inner.primID = target.primitive;
      inner.rayhit = reinterpret_cast<RTCRayHitN*>(&packet);
      shape.intersect(&inner);
    } else if (size > 1 || valid[0] != 0) {
      embree::AnyPacket<size>::intersect(valid, callbacks.groups[static_cast<std::size_t>(target.group)],
                                         arguments->context, packet);
    }
  }
  RTCRayN* const outer = RTCRayHitN_RayN(arguments->rayhit, size);
  RTCHitN* const outer_hit = RTCRayHitN_HitN(arguments->rayhit, size);
  RTCHitN* const inner_hit = RTCRayHitN_HitN(reinterpret_cast<RTCRayHitN*>(&packet), size);
  for (int lane = 0; lane < size; ++lane) {
    const auto i = static_cast<unsigned>(lane);
    const unsigned id = RTCRayN_id(outer, size, i);
    const bool hit = arguments->valid[lane] != 0 && nearest.instance[id] == number;
    if (hit) {
      RTCRayN_tfar(outer, size, i) = behind(nearest.distance[id]);
      RTCHitN_u(outer_hit, size, i) = RTCHitN_u(inner_hit, size, i);
      RTCHitN_v(outer_hit, size, i) = RTCHitN_v(inner_hit, size, i);
    }
    if (embree::callback_reports_hits) arguments->valid[lane] = hit ? -1 : 0;
  }
}

template <int size>
void occlude_instance(const RTCOccludedFunctionNArguments* arguments) {
  const auto& callbacks = *static_cast<const InstanceCallbacks*>(arguments->geometryUserPtr);
  auto& nearest = *reinterpret_cast<embree::NearestHits*>(arguments->context);
  const InstanceTarget& target = callbacks.instances->target(arguments->primID);
  typename embree::AnyPacket<size>::Ray packet;
  std::memcpy(&packet, arguments->ray, sizeof packet);
  alignas(64) int valid[size];
  std::copy_n(arguments->valid, size, valid);
  auto* const rays = reinterpret_cast<RTCRayN*>(&packet);
  transform_rays<size>(callbacks.instances->object_from_world(arguments->primID), rays, valid);
  {
    const InInstance here(nearest, callbacks.instances->number(arguments->primID));
    if (target.is_shape) {
      const InstanceCallbacks::Shape& shape = callbacks.shape(target);
      RTCOccludedFunctionNArguments inner = *arguments;
      inner.valid = valid;
      inner.geometryUserPtr = shape.table;
      inner.geomID = target.shape_type;
      inner.primID = target.primitive;
      inner.ray = rays;
      shape.occluded(&inner);
    } else if (size > 1 || valid[0] != 0) {
      embree::AnyPacket<size>::occluded(valid, callbacks.groups[static_cast<std::size_t>(target.group)],
                                        arguments->context, packet);
    }
  }
  for (int lane = 0; lane < size; ++lane) {
    const bool hit = arguments->valid[lane] != 0 && RTCRayN_tfar(rays, size, static_cast<unsigned>(lane)) < 0;
    if (hit) RTCRayN_tfar(arguments->ray, size, static_cast<unsigned>(lane)) = -infinity<float>();
    if (embree::callback_reports_hits) arguments->valid[lane] = hit ? -1 : 0;
  }
}

inline void intersect_instances(const RTCIntersectFunctionNArguments* arguments) {
  switch (arguments->N) {
    case 16:
      return intersect_instance<16>(arguments);
    case 8:
      return intersect_instance<8>(arguments);
    case 4:
      return intersect_instance<4>(arguments);
    default:
      return intersect_instance<1>(arguments);
  }
}
inline void occlude_instances(const RTCOccludedFunctionNArguments* arguments) {
  switch (arguments->N) {
    case 16:
      return occlude_instance<16>(arguments);
    case 8:
      return occlude_instance<8>(arguments);
    case 4:
      return occlude_instance<4>(arguments);
    default:
      return occlude_instance<1>(arguments);
  }
}

inline void instance_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& callbacks = *static_cast<const InstanceCallbacks*>(arguments->geometryUserPtr);
  set_bounds(*arguments->bounds_o, callbacks.instances->bounds(arguments->primID));
}

}  // namespace detail

/// The callbacks for a user geometry of all instances; what they need must outlive it.
inline void set_callbacks(RTCGeometry geometry, InstanceCallbacks& callbacks) {
  rtcSetGeometryUserData(geometry, &callbacks);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(callbacks.instances->size()));
  rtcSetGeometryBoundsFunction(geometry, &detail::instance_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &detail::intersect_instances);
  rtcSetGeometryOccludedFunction(geometry, &detail::occlude_instances);
}

/// A shape's callbacks for InstanceCallbacks, with its table.
template <class Shape>
InstanceCallbacks::Shape shape_callbacks(const ShapeTable<Shape>& table) {
  if constexpr (UserGeometry<Shape>) {
    return {const_cast<ShapeTable<Shape>*>(&table), &detail::callback<detail::Intersect<Shape>>,
            &detail::callback<detail::Occlude<Shape>>};
  } else {
    return {};
  }
}

}  // namespace raytrace
