// The objects of one shape as the tracer keeps them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "raytrace/math/affine.h"
#include "raytrace/scene/instance_table.h"
#include "raytrace/shapes/kernels.h"

namespace raytrace {

/// What the texture coordinates of some objects are taken from: the object as it was before its transform, and where a
/// point of its surface lay then. Of those whose coordinates the transform changes; of all that it changes where
/// textures are fixed to objects.
template <class Record>
struct UvFrames {
  std::vector<std::int32_t> of_object;  ///< of each object; -1: its record has its coordinates. Empty: all have
  // Before the transform, less a point of those that lie far from the origin there.
  std::vector<Record> records;
  std::vector<Vec3f> origins;                                             ///< the points
  std::vector<AffineRecord<float>> object_from_world, world_from_object;  ///< maps of what is less them

  bool empty() const { return of_object.empty(); }
  /// Of object i, one of `count`. affine: the transform; record: less the origin.
  void add(std::size_t i, std::size_t count, const Record& record, Affine affine, const Vec3d& origin) {
    if (length(origin) > 0) affine = affine * Affine{.origin = origin};
    of_object.resize(count, -1);
    of_object[i] = static_cast<std::int32_t>(records.size());
    records.push_back(record);
    origins.emplace_back(origin);
    world_from_object.push_back(to_float(affine));
    object_from_world.push_back(to_float(affine.inverse()));
  }
};

/// The records of all objects of one shape.
template <class Shape>
struct ShapeTable {
  using Record = decltype(Kernel<Shape>::record(std::declval<typename Shape::Parameters>()));
  std::vector<Record> records;
  std::vector<bool> instanced;  ///< those that rays meet by an instance alone; empty: none
  UvFrames<Record> uv_frames;

  bool is_instanced(std::size_t i) const { return !instanced.empty() && instanced[i]; }
};

}  // namespace raytrace
