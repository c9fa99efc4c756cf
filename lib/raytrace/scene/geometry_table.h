// The objects of a scene as the tracer keeps them: records by shape, and what each of Embree's geometries is made of.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/lanes.h"
#include "raytrace/math/simd.h"
#include "raytrace/scene/curve_table.h"
#include "raytrace/scene/hits.h"
#include "raytrace/scene/instance_table.h"
#include "raytrace/scene/mesh_table.h"
#include "raytrace/scene/shape_table.h"

namespace raytrace {

/// One of Embree's geometries: all objects of a shape, each of which is a primitive, or the faces of a mesh or the
/// pieces of curves, which are one object.
struct Geometry {
  std::uint32_t primitives;
  std::int32_t first_object;  ///< objects are counted through all geometries
  // Both null: a shape's.
  const MeshTable* mesh = nullptr;
  const CurveTable* curves = nullptr;

  bool is_one_object() const { return mesh != nullptr || curves != nullptr; }
};

/// The spheres of a cloud: those of the table of spheres from `first` on, before `end`.
struct CloudSpheres {
  std::int32_t first, end;
  std::int32_t object;
  std::shared_ptr<const PointCloud> data;
  AffineRecord<float> object_from_world;
};

/// The objects of the world, or of a group.
///
/// Geometry i is that of the shape of index i in the Shapes registry; the meshes follow, in their order, and then
/// curves. One without objects has no counterpart in Embree's scene. The spheres of clouds follow the single ones in
/// their table; each cloud is one object, which follow the meshes, and are followed by curves. Shapes that their
/// transforms make other shapes are in the shape's table as they are before them; rays meet them by an instance each.
class GeometryTable {
 public:
  /// has_object_space: whether textures may ask where a point lay before its object's transform. origin: subtracted
  /// from all points, in double.
  GeometryTable(const ObjectLists& objects, const Vec3d& origin, const MeshMaterials& materials, bool has_object_space,
                int threads);
  /// The world's: all objects and groups.
  GeometryTable(const SceneDescription& description, const Vec3d& origin, const MeshMaterials& materials,
                bool has_object_space, int threads);

  const std::vector<Geometry>& geometries() const { return geometries_; }
  const Geometry& geometry(std::uint32_t index) const { return geometries_[index]; }
  template <class Shape>
  const ShapeTable<Shape>& table() const {
    return std::get<ShapeTable<Shape>>(tables_);
  }
  /// Only of the world. Meshes that others have copies of count as groups.
  const std::vector<std::unique_ptr<const GeometryTable>>& groups() const { return groups_; }
  const InstanceTable& instances() const { return instances_; }

  bool has_clouds() const { return !clouds_.empty(); }
  /// Whether all that has bounds is a shape that rays meet as it stands in its table.
  bool has_shapes_only() const { return meshes_.empty() && curves_.empty() && instances_.empty(); }
  bool has_curves() const { return !curves_.empty(); }
  std::uint64_t primitive_count() const;
  /// Around all objects that have bounds; of negative radius if there are none.
  BoundingSphere bounding_sphere() const;
  /// Each object that has bounds, and each instance, if any of its materials is wanted: wanted_materials has a 1 at its
  /// number.
  struct BoundedObject {
    Bounds bounds;
    double radius;           ///< of a sphere around it, whose center is that of the bounds
    std::int32_t object;     ///< its number; of an instance, -1 less its number, counted from 0
    std::uint32_t geometry;  ///< that it is of; of instances the number behind the last
  };
  std::vector<BoundedObject> bounded_objects(std::span<const std::uint8_t> wanted_materials) const;
  /// Around all that has such a material, where the scene's file has it: in the world, whose origin is given, or in the
  /// space of its group. Only of the world. Of negative size if there is none.
  Bounds bounds_in_file(std::span<const std::uint8_t> wanted_materials, const Vec3d& origin) const;
  /// The instances of groups with such a material, by index, and the map of each from the space that its group has in
  /// the scene's file. Only of the world.
  struct PlaceOfGroup {
    std::size_t instance;
    Affine world_from_group;
  };
  std::vector<PlaceOfGroup> places_of_groups(std::span<const std::uint8_t> wanted_materials) const;
  /// Of so many materials, those that objects have: 1, else 0.
  std::vector<std::uint8_t> used_materials(std::int32_t materials) const;

  // Of what was hit; at least one lane must have a hit, and lanes without one follow one that has.

  IntN object(const Hits& hits) const;
  IntN material(const Hits& hits) const;
  /// Of what one ray hit: its instance, geometry and primitive, as Hits have them.
  std::int32_t material_of(std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive) const;
  /// Of all lanes with a hit, if they hit the same primitive, or a mesh that has one material.
  std::optional<std::int32_t> only_material(const Hits& hits) const;

  /// Whether any object is a shadow catcher, and the lanes that hit one.
  bool has_shadow_catchers() const { return catchers_.has_any; }
  MaskN shadow_catchers(const Hits& hits) const { return lanes_of(&GeometryTable::catchers_, hits); }
  /// Whether any object is not visible to the camera, the lanes that hit one, and whether what one ray hit is of one.
  bool has_invisible() const { return invisible_.has_any; }
  MaskN invisible(const Hits& hits) const { return lanes_of(&GeometryTable::invisible_, hits); }
  bool is_invisible(std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive) const {
    return is_of(&GeometryTable::invisible_, instance, geometry, primitive);
  }

  /// For lanes that hit the same geometry of the same table: f(table, geometry, those lanes).
  template <class Function>
  void for_each_geometry(const Hits& hits, const Function& f) const;

  /// For lanes that hit spheres of the same cloud: f(cloud, those lanes). lanes: those that hit a sphere.
  template <class Function>
  void for_each_cloud(const IntN& sphere, const MaskN& lanes, const Function& f) const;

 private:
  /// A shape that is another under its transform.
  struct TransformedShape {
    InstanceTarget target;
    Affine affine;
    Bounds bounds;  ///< before it
  };

  /// Tables of the meshes that those of the world or a group have copies of, which follow the groups' tables.
  void add_copied_meshes(const ObjectLists& objects, const MeshMaterials& materials, int threads);
  /// Those of a group that lies far from the origin of its space are moved next to it.
  static std::unique_ptr<const GeometryTable> of_group(const ObjectLists& objects, const MeshMaterials& materials,
                                                       bool has_object_space, int threads);
  void add_objects(const ObjectLists& objects, const Vec3d& origin, const MeshMaterials& materials, int threads);
  void add_instances(const SceneDescription& description, const Vec3d& origin,
                     std::span<const std::int32_t> first_materials);
  void add_shapes(const ObjectLists& objects, const Vec3d& origin);
  void add_clouds(const std::vector<ObjectItem<SphereCloud>>& clouds, const Vec3d& origin);
  /// Of a geometry's primitives, for every lane one that exists.
  IntN object(std::uint32_t geometry, const IntN& primitive) const;
  /// The object and the material of a primitive of this table.
  std::int32_t own_object(std::uint32_t geometry, std::uint32_t primitive) const;
  std::int32_t own_material(std::uint32_t geometry, std::uint32_t primitive) const;
  /// From the space of an instance's objects to that which they have in the scene's file.
  Affine file_from_instance(std::size_t instance) const;
  const TransformedShape* transformed_shape(const InstanceTarget& target) const;
  /// The table of an instance's objects.
  const GeometryTable& table_of(const InstanceTarget& target) const {
    return target.group == InstanceTarget::no_group ? *this : *groups_[static_cast<std::size_t>(target.group)];
  }
  /// Objects for which something holds, which is false of most.
  struct ObjectSet {
    std::vector<std::int32_t> objects;  ///< by number
    std::vector<bool> instances;        ///< whether all of an instance is of it
    bool has_any = false;
  };
  bool is_of(ObjectSet GeometryTable::* set, std::uint32_t instance, std::uint32_t geometry,
             std::uint32_t primitive) const;
  MaskN lanes_of(ObjectSet GeometryTable::* set, const Hits& hits) const;
  /// The same number, but that of the cloud where lanes that hit a sphere hit one of a cloud.
  IntN or_cloud(const IntN& object, const IntN& sphere, const MaskN& lanes) const;
  void set_object_materials(const ObjectLists& objects, std::span<const std::int32_t> first_materials, int threads);
  void set_object_sets(const ObjectLists& objects, int threads);
  void set_bounds(int threads);

  bool has_object_space_;  ///< all transforms of shapes are kept then
  Vec3d origin_;           ///< subtracted from all points
  TupleOf<Shapes, ShapeTable>::type tables_;
  // They stay where they are.
  std::deque<MeshTable> meshes_;
  std::deque<CurveTable> curves_;
  std::vector<CloudSpheres> clouds_;
  std::vector<Geometry> geometries_;
  // Of each geometry, side by side: its first object, and 0 if it is one object, else all bits.
  std::vector<std::int32_t> first_objects_, primitive_masks_;
  std::vector<std::int32_t> object_materials_;  ///< of each object; of a mesh, its first
  bool objects_have_one_material_ = true;       ///< each
  ObjectSet catchers_, invisible_;
  std::vector<TransformedShape> transformed_;
  Bounds bounds_ = empty_bounds;                              ///< of all that is not an instance
  std::vector<std::unique_ptr<const GeometryTable>> groups_;  ///< and behind them the meshes that are copied
  std::vector<std::size_t> first_copied_;                     ///< of the world, and of each group, the first of those
  InstanceTable instances_;
};

template <class Function>
void GeometryTable::for_each_geometry(const Hits& hits, const Function& f) const {
  const bool in_instances = hits.in_instances;
  const IntN none(InstanceTarget::no_group);
  const IntN group = !in_instances ? none
                                   : select_lanes(float_mask<FloatN>(hits.instance == UintN(0u)), none,
                                                  instances_.group(hits.instance));
  for (MaskN left = hits.hit; any(left);) {
    const std::size_t first = first_lane(left);
    const std::uint32_t geometry = hits.geometry.get(first);
    MaskN here = left & float_mask<FloatN>(hits.geometry == UintN(geometry));
    const GeometryTable* table = this;
    if (in_instances) {
      here = here & float_mask<FloatN>(group == IntN(group.get(first)));
      if (group.get(first) >= 0) table = groups_[static_cast<std::size_t>(group.get(first))].get();
    }
    left = left & !here;
    f(*table, geometry, here);
  }
}

template <class Function>
void GeometryTable::for_each_cloud(const IntN& sphere, const MaskN& lanes, const Function& f) const {
  if (clouds_.empty()) return;
  for (MaskN left = lanes & float_mask<FloatN>(sphere >= IntN(clouds_.front().first)); any(left);) {
    const std::int32_t first = sphere.get(first_lane(left));
    const CloudSpheres& cloud =
        *std::prev(std::upper_bound(clouds_.begin(), clouds_.end(), first,
                                    [](std::int32_t i, const CloudSpheres& other) { return i < other.first; }));
    const MaskN here =
        left & float_mask<FloatN>(sphere >= IntN(cloud.first)) & float_mask<FloatN>(sphere < IntN(cloud.end));
    left = left & !here;
    f(cloud, here);
  }
}

}  // namespace raytrace
