// The objects of a scene as the tracer keeps them: records by shape, and what each of Embree's geometries is made of.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/simd.h"
#include "raytrace/scene/hits.h"
#include "raytrace/scene/mesh_table.h"
#include "raytrace/shapes/kernels.h"

namespace raytrace {

/// The records of all objects of one shape.
template <class Shape>
struct ShapeTable {
  using Record = decltype(Kernel<Shape>::record(std::declval<typename Shape::Parameters>()));
  std::vector<Record> records;
};

/// One of Embree's geometries: all objects of a shape, each of which is a primitive, or the faces of a mesh, which is
/// one object.
struct Geometry {
  std::uint32_t primitives;
  std::int32_t first_object;  ///< objects are counted through all geometries
  const MeshTable* mesh;      ///< null: a shape's
};

/// Geometry i is that of the shape of index i in the Shapes registry; the meshes follow, in their order. One without
/// objects has no counterpart in Embree's scene.
class GeometryTable {
 public:
  /// origin: subtracted from all points, in double. first_materials: of each material type, the number of its first
  /// material, all counted together.
  GeometryTable(const SceneDescription& description, const Vec3d& origin, std::span<const std::int32_t> first_materials,
                int threads);

  const std::vector<Geometry>& geometries() const { return geometries_; }
  const Geometry& geometry(std::uint32_t index) const { return geometries_[index]; }
  template <class Shape>
  const ShapeTable<Shape>& table() const {
    return std::get<ShapeTable<Shape>>(tables_);
  }
  bool has_meshes() const { return !meshes_.empty(); }
  std::uint64_t object_count() const { return object_materials_.size(); }
  std::uint64_t primitive_count() const;
  /// Around all objects that have bounds; of negative radius if there are none.
  const BoundingSphere& bounding_sphere() const { return bounding_sphere_; }
  /// Of so many materials, those that objects have: 1, else 0.
  std::vector<std::uint8_t> used_materials(std::int32_t materials) const;

  // Of what was hit; at least one lane must have a hit, and lanes without one follow one that has.

  IntN object(const Hits& hits) const;
  IntN material(const Hits& hits) const;
  /// Of all lanes with a hit, if they hit the same primitive, or a mesh that has one material.
  std::optional<std::int32_t> only_material(const Hits& hits) const;

 private:
  void add_shapes(const SceneDescription& description, const Vec3d& origin);
  void set_object_materials(const SceneDescription& description, std::span<const std::int32_t> first_materials,
                            int threads);
  void set_bounding_sphere(int threads);

  TupleOf<Shapes, ShapeTable>::type tables_;
  std::deque<MeshTable> meshes_;  ///< they stay where they are
  std::vector<Geometry> geometries_;
  // Of each geometry, side by side: its first object, and 0 if it is one object, else all bits.
  std::vector<std::int32_t> first_objects_, primitive_masks_;
  std::vector<std::int32_t> object_materials_;  ///< of each object; of a mesh, its first
  BoundingSphere bounding_sphere_{{0, 0, 0}, -1};
};

}  // namespace raytrace
