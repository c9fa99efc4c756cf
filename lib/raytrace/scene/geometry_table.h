// The objects of a scene as the tracer keeps them: records by shape, and what each of Embree's geometries is made of.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/simd.h"
#include "raytrace/scene/hits.h"
#include "raytrace/shapes/kernels.h"

namespace raytrace {

/// The records of all objects of one shape.
template <class Shape>
struct ShapeTable {
  using Record = decltype(Kernel<Shape>::record(std::declval<typename Shape::Parameters>()));
  std::vector<Record> records;
};

/// A run of a shape's records, which is one of Embree's geometries. Each primitive is an object.
struct Geometry {
  std::uint32_t shape_type;    ///< index in the Shapes registry
  std::uint32_t first_record;  ///< in the shape's table
  std::uint32_t primitives;    ///< how many records it has
  std::int32_t first_object;   ///< objects are counted through all geometries
};

/// Geometry i is of the shape of index i in the Shapes registry, and has all of its objects. One without objects has no
/// counterpart in Embree's scene.
class GeometryTable {
 public:
  /// origin: subtracted from all points, in double. first_materials: of each material type, the number of its first
  /// material, all counted together.
  GeometryTable(const SceneDescription& description, const Vec3d& origin, std::span<const std::int32_t> first_materials,
                int threads);

  const std::array<Geometry, Shapes::size>& geometries() const { return geometries_; }
  const Geometry& geometry(std::uint32_t index) const { return geometries_[index]; }
  template <class Shape>
  const ShapeTable<Shape>& table() const {
    return std::get<ShapeTable<Shape>>(tables_);
  }
  std::uint64_t object_count() const { return object_materials_.size(); }
  /// Around all objects that have bounds; of negative radius if there are none.
  const BoundingSphere& bounding_sphere() const { return bounding_sphere_; }
  /// Of so many materials, those that objects have: 1, else 0.
  std::vector<std::uint8_t> used_materials(std::int32_t materials) const;

  // Of what was hit; at least one lane must have a hit, and lanes without one follow one that has.

  IntN object(const Hits& hits) const;
  IntN material(const Hits& hits) const { return gather(object_materials_.data(), object(hits)); }
  /// Of the first lane with a hit.
  std::int32_t first_material(const Hits& hits) const {
    const std::int32_t object = geometries_[hits.first_geometry].first_object + hits.first_primitive;
    return object_materials_[static_cast<std::size_t>(object)];
  }

 private:
  void set_bounding_sphere(int threads);

  TupleOf<Shapes, ShapeTable>::type tables_;
  std::array<Geometry, Shapes::size> geometries_{};
  std::array<std::int32_t, Shapes::size> first_objects_{};  ///< of each geometry, side by side
  std::vector<std::int32_t> object_materials_;              ///< of each object
  BoundingSphere bounding_sphere_{{0, 0, 0}, -1};
};

}  // namespace raytrace
