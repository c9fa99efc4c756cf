// Embree's callbacks of instances: one user geometry has all that stand still, a primitive each, and another those that
// move while the shutter is open, whose boxes Embree knows at each moment.
//
// They transform the rays by our own arithmetic, which is the same for packets and single rays, and put them to the
// group's own scene, or to the callback of a single shape. So a million instances take what their matrices and boxes
// take, groups may be of any kind in Embree 3 and 4, and equal distances are settled as everywhere (callbacks.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "raytrace/accel/callbacks.h"
#include "raytrace/accel/embree.h"
#include "raytrace/description/motion.h"
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

/// What Embree hands to the callbacks: all instances but those that move, or those.
struct InstanceGeometry {
  const InstanceCallbacks* callbacks = nullptr;
  bool moves = false;

  std::uint32_t instance(std::uint32_t primitive) const {
    return moves ? callbacks->instances->moving()[primitive] : primitive;
  }
};

namespace detail {

template <int size>
using InstanceLanes = FloatLanes<size == 1 ? 4 : size>;

/// The map of an instance that moves, for each ray of a packet at its own time.
template <int size>
AffineRecord<InstanceLanes<size>> moving_map(const InstanceTable& instances, std::uint32_t instance, RTCRayN* rays,
                                             const int* valid) {
  using F = InstanceLanes<size>;
  alignas(64) float columns[12][size] = {};
  for (int lane = 0; lane < size; ++lane) {
    if (valid[lane] == 0) continue;
    const float time = RTCRayN_time(rays, size, static_cast<unsigned>(lane));
    const auto numbers = std::bit_cast<std::array<float, 12>>(instances.maps(instance, time).object_from_world);
    for (std::size_t i = 0; i < 12; ++i) columns[i][lane] = numbers[i];
  }
  const auto vector = [&](std::size_t first) {
    return Vec3<F>(load_lanes<F>(columns[first], size), load_lanes<F>(columns[first + 1], size),
                   load_lanes<F>(columns[first + 2], size));
  };
  return {vector(0), vector(3), vector(6), vector(9)};
}

/// Transforms the `size` rays of a packet in which Embree keeps them; those that it does not take become invalid.
template <int size, class T>
void transform_rays(const AffineRecord<T>& object_from_world, RTCRayN* rays, int* valid) {
  using F = InstanceLanes<size>;
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

/// The same by an instance's map. What moves is a geometry of its own, whose primitives are counted through it alone.
template <int size>
void transform_rays(const InstanceTable& instances, std::uint32_t instance, RTCRayN* rays, int* valid) {
  if (instances.moves(instance)) [[unlikely]]
    transform_rays<size>(moving_map<size>(instances, instance, rays, valid), rays, valid);
  else
    transform_rays<size>(instances.object_from_world(instance), rays, valid);
}

/// What is instanced, as the rays of a query that is under way see it: its callbacks keep their hits under the
/// instance's number.
class InInstance {
 public:
  InInstance(embree::Query& query, std::uint32_t number, std::int32_t material) : query_(query) {
    query.current_instance = number;
    query.current_material = material;
  }
  ~InInstance() {
    query_.current_instance = 0;
    query_.current_material = -1;
  }
  InInstance(const InInstance&) = delete;
  InInstance& operator=(const InInstance&) = delete;

 private:
  embree::Query& query_;
};

/// Puts the rays of a callback's arguments, `rays` their member, to what is instanced: `packet`, a copy of them,
/// becomes its own. ask_shape: the shape's callback, ask_group: the query of a group's scene. Returns the instance's
/// number.
template <int size, class Arguments, class Rays, class Packet, class AskGroup>
std::uint32_t ask_instance(const Arguments* arguments, Rays* Arguments::* rays, Packet& packet,
                           void (*InstanceCallbacks::Shape::*ask_shape)(const Arguments*), const AskGroup& ask_group) {
  const auto& geometry = *static_cast<const InstanceGeometry*>(arguments->geometryUserPtr);
  const InstanceCallbacks& callbacks = *geometry.callbacks;
  const std::uint32_t instance = geometry.instance(arguments->primID);
  const InstanceTarget& target = callbacks.instances->target(instance);
  std::memcpy(&packet, arguments->*rays, sizeof packet);
  alignas(64) int valid[size];
  std::copy_n(arguments->valid, size, valid);
  transform_rays<size>(*callbacks.instances, instance, reinterpret_cast<RTCRayN*>(&packet), valid);
  const std::uint32_t number = callbacks.instances->number(instance);
  embree::Query& query = embree::Query::of(arguments);
  const InInstance here(query, number, callbacks.instances->materials()[instance]);
  if (target.is_shape) {
    const InstanceCallbacks::Shape& shape = callbacks.shape(target);
    Arguments inner = *arguments;
    inner.valid = valid;
    inner.geometryUserPtr = shape.table;
    inner.geomID = target.shape_type;
    inner.primID = target.primitive;
    inner.*rays = reinterpret_cast<Rays*>(&packet);
    (shape.*ask_shape)(&inner);
  } else if (size > 1 || valid[0] != 0) {
    ask_group(valid, callbacks.groups[static_cast<std::size_t>(target.group)], query, packet);
  }
  return number;
}

struct IntersectInstance {
  using Arguments = RTCIntersectFunctionNArguments;

  template <int size>
  static void call(const Arguments* arguments) {
    typename embree::Packet<size>::RayHit packet;
    const std::uint32_t number = ask_instance<size>(
        arguments, &Arguments::rayhit, packet, &InstanceCallbacks::Shape::intersect, embree::Packet<size>::intersect);
    const embree::Query& query = embree::Query::of(arguments);
    RTCRayN* const outer = RTCRayHitN_RayN(arguments->rayhit, size);
    RTCHitN* const outer_hit = RTCRayHitN_HitN(arguments->rayhit, size);
    RTCHitN* const inner_hit = RTCRayHitN_HitN(reinterpret_cast<RTCRayHitN*>(&packet), size);
    for (int lane = 0; lane < size; ++lane) {
      const auto i = static_cast<unsigned>(lane);
      const unsigned id = RTCRayN_id(outer, size, i);
      const bool hit = arguments->valid[lane] != 0 && query.instance[id] == number;
      if (hit) {
        RTCRayN_tfar(outer, size, i) = behind(query.distance[id]);
        RTCHitN_u(outer_hit, size, i) = RTCHitN_u(inner_hit, size, i);
        RTCHitN_v(outer_hit, size, i) = RTCHitN_v(inner_hit, size, i);
      }
      if (embree::callback_reports_hits) arguments->valid[lane] = hit ? -1 : 0;
    }
  }
};

struct OccludeInstance {
  using Arguments = RTCOccludedFunctionNArguments;

  template <int size>
  static void call(const Arguments* arguments) {
    typename embree::Packet<size>::Ray packet;
    ask_instance<size>(arguments, &Arguments::ray, packet, &InstanceCallbacks::Shape::occluded,
                       embree::Packet<size>::occluded);
    auto* const rays = reinterpret_cast<RTCRayN*>(&packet);
    for (int lane = 0; lane < size; ++lane) {
      const bool hit = arguments->valid[lane] != 0 && RTCRayN_tfar(rays, size, static_cast<unsigned>(lane)) < 0;
      if (hit) RTCRayN_tfar(arguments->ray, size, static_cast<unsigned>(lane)) = -infinity<float>();
      if (embree::callback_reports_hits) arguments->valid[lane] = hit ? -1 : 0;
    }
  }
};

template <class Callback>
void instance_callback(const typename Callback::Arguments* arguments) {
  switch (arguments->N) {
    case 16:
      return Callback::template call<16>(arguments);
    case 8:
      return Callback::template call<8>(arguments);
    case 4:
      return Callback::template call<4>(arguments);
    default:
      return Callback::template call<1>(arguments);
  }
}

inline void instance_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& geometry = *static_cast<const InstanceGeometry*>(arguments->geometryUserPtr);
  const InstanceTable& instances = *geometry.callbacks->instances;
  const std::uint32_t instance = geometry.instance(arguments->primID);
  if (geometry.moves)
    set_bounds(*arguments->bounds_o, instances.bounds_at(instance, arguments->timeStep));
  else
    set_bounds(*arguments->bounds_o, instances.moves(instance) ? empty_bounds : instances.bounds(instance));
}

}  // namespace detail

/// The callbacks for a user geometry of instances, which must outlive it.
inline void set_callbacks(RTCGeometry geometry, InstanceGeometry& instances) {
  const InstanceTable& table = *instances.callbacks->instances;
  rtcSetGeometryUserData(geometry, &instances);
  rtcSetGeometryUserPrimitiveCount(geometry,
                                   static_cast<unsigned>(instances.moves ? table.moving().size() : table.size()));
  if (instances.moves) rtcSetGeometryTimeStepCount(geometry, shutter_moments);
  rtcSetGeometryBoundsFunction(geometry, &detail::instance_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &detail::instance_callback<detail::IntersectInstance>);
  rtcSetGeometryOccludedFunction(geometry, &detail::instance_callback<detail::OccludeInstance>);
}

/// A shape's callbacks for InstanceCallbacks, with its table.
template <class Shape>
InstanceCallbacks::Shape shape_callbacks(const ShapeTable<Shape>& table) {
  if constexpr (UserGeometry<Shape>) {
    return {const_cast<ShapeTable<Shape>*>(&table), &detail::callback<detail::Intersect<detail::ShapeObjects<Shape>>>,
            &detail::callback<detail::Occlude<detail::ShapeObjects<Shape>>>};
  } else {
    return {};
  }
}

}  // namespace raytrace
