// What the maps of instances make of points and normals.
#pragma once

#include "raytrace/math/ray.h"
#include "raytrace/scene/instance_table.h"

namespace raytrace {

/// Of the lanes' instances.
struct InstanceMaps {
  AffineRecord<FloatN> world_from_object, object_from_world;

  /// A normal of objects in the world, of unit length.
  Vec3<FloatN> normal_to_world(const Vec3<FloatN>& n) const { return turned(object_from_world, n); }
  /// The way back.
  Vec3<FloatN> normal_to_object(const Vec3<FloatN>& n) const { return turned(world_from_object, n); }

  /// Bound of the distance between p in the world and the true surface: the surface's own error there, and the
  /// roundings of the point and of rays that come to it, on either side of the maps.
  FloatN error(const Vec3<FloatN>& in_object, const FloatN& error_in_object, const Vec3<FloatN>& p) const {
    const FloatN scale = size(world_from_object);
    const FloatN stretch = scale * size(object_from_world);
    const FloatN reach = largest_component(p) + largest_component(world_from_object.origin);
    return scale * error_in_object + scale * largest_component(in_object) * FloatN(0x1p-22F) +
           reach * stretch * FloatN(0x1p-23F);
  }

  /// What a density per solid angle in the objects' space is in the world, in the direction that is `in_object` there.
  FloatN density_to_world(const FloatN& density, const Vec3<FloatN>& in_object, const Vec3<FloatN>& in_world) const {
    const FloatN over_scale = FloatN(1) / size(world_from_object);
    const auto scaled = [&](const Vec3<FloatN>& v) { return v * over_scale; };
    const auto& [x, y, z, origin] = world_from_object;
    const FloatN volume = abs(dot(scaled(x), cross(scaled(y), scaled(z))));
    const FloatN distance = length(in_object), stretch = length(in_world) * over_scale / distance;
    return select((volume > FloatN(0)) & (distance > FloatN(0)), density * stretch * stretch * stretch / volume,
                  FloatN(0));
  }

 private:
  /// By the transpose of the other map. Of any scale, so that squares neither overflow nor vanish.
  static Vec3<FloatN> turned(const AffineRecord<FloatN>& other, const Vec3<FloatN>& n) {
    const Vec3<FloatN> normal{dot(other.x, n), dot(other.y, n), dot(other.z, n)};
    const Vec3<FloatN> scaled = normal * inverse_power_of_2(largest_component(normal));
    const FloatN squared_length = dot(scaled, scaled);
    return select(squared_length > FloatN(0), scaled * (FloatN(1) / sqrt(squared_length)), scaled);
  }
  static FloatN size(const AffineRecord<FloatN>& affine) {
    return abs(affine.x.x) + abs(affine.x.y) + abs(affine.x.z) + abs(affine.y.x) + abs(affine.y.y) + abs(affine.y.z) +
           abs(affine.z.x) + abs(affine.z.y) + abs(affine.z.z);
  }
};

/// number: 0 for lanes without an instance, which get the first one's maps. time: as of InstanceTable::maps().
inline InstanceMaps maps_of(const InstanceTable& instances, const UintN& number, const FloatN& time) {
  if (instances.moving().empty())
    return {instances.world_from_object(number, time), instances.object_from_world(number, time)};
  const auto [world_from_object, object_from_world] = instances.moving_maps(number, time);
  return {world_from_object, object_from_world};
}

}  // namespace raytrace
