// Groups, and where their instances are.
#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "raytrace/math/float_origin.h"
#include "raytrace/scene/geometry_table.h"

namespace raytrace {

namespace {

/// What an instance says of all that is in it.
struct Flags {
  bool catches = false, is_invisible = false;

  /// Of an item in there.
  template <class Item>
  Flags in(const Item& item) const {
    return {catches || item.shadowcatcher, is_invisible || !item.visible};
  }
};

/// Where something is: one map, or one for each moment while the shutter is open.
using Maps = std::vector<Affine>;

/// First the inner ones.
Maps composed(const Maps& outer, const Maps& inner) {
  Maps maps;
  for (std::size_t i = 0; i < std::max(outer.size(), inner.size()); ++i)
    maps.push_back(outer[outer.size() == 1 ? 0 : i] * inner[inner.size() == 1 ? 0 : i]);
  return maps;
}

/// Of points less an origin.
Maps from_origin(const Maps& maps, const Vec3d& origin) {
  return length(origin) > 0 ? composed(maps, {Affine{.origin = origin}}) : maps;
}

}  // namespace

std::unique_ptr<const GeometryTable> GeometryTable::of_group(const ObjectLists& objects, const MeshMaterials& materials,
                                                             bool has_object_space, int threads) {
  Vec3d origin(0, 0, 0);
  const auto table = [&] {
    return std::make_unique<const GeometryTable>(objects, origin, materials, has_object_space, threads);
  };
  auto result = table();
  // The first time, floats may be too coarse for its size.
  for (int time = 0; time < 2 && result->bounds_.lower.x <= result->bounds_.upper.x; ++time) {
    const auto [center, radius] = sphere_around(result->bounds_);
    // What is small may stand anywhere in a large group.
    const double distance = length(center), near = std::max(radius, near_the_origin);
    if (!(distance > near) && !is_coarse(distance, radius)) break;
    origin += rounded_origin(center, radius);
    result = table();
  }
  return result;
}

void GeometryTable::add_copied_meshes(const ObjectLists& objects, const MeshMaterials& materials, int threads) {
  first_copied_.push_back(groups_.size());
  for (const auto& item : std::get<ObjectItems<Mesh>>(objects))
    for (const MeshCopies& copies : item.data->copies) {
      ObjectLists alone;
      ObjectItem<Mesh>& mesh = std::get<ObjectItems<Mesh>>(alone).emplace_back();
      mesh.parameters.normals = item.parameters.normals;
      mesh.data = copies.mesh;
      mesh.materials = item.materials;
      groups_.push_back(of_group(alone, materials, has_object_space_, threads));
    }
}

void GeometryTable::add_instances(const SceneDescription& description, const Vec3d& origin,
                                  std::span<const std::int32_t> first_materials) {
  std::unordered_map<std::string_view, std::size_t> numbers;
  for (const Group& group : description.groups) numbers.emplace(group.name, numbers.size());
  const auto material_number = [&](const ObjectItem<Instance>& item, std::int32_t outer) {
    if (outer >= 0 || item.material == no_material) return outer;
    return first_materials[item.material.type] + static_cast<std::int32_t>(item.material.index);
  };
  // An instance of a group is one of its own objects, and one of each instance in it.
  const auto add = [&](const InstanceTarget& target, const Maps& maps, const Bounds& box, std::int32_t object,
                       std::int32_t material, const Flags& flags) {
    const auto put = [](ObjectSet& set, bool is_in_set) {
      set.instances.push_back(is_in_set);
      set.has_any |= is_in_set;
    };
    put(catchers_, flags.catches);
    put(invisible_, flags.is_invisible);
    if (maps.size() == 1)
      instances_.add(target, maps.front(), box, object, material);
    else
      instances_.add_moving(target, maps, box, object, material);
  };
  // Copies of meshes in the world, or in a group, are as the mesh's own faces. object: of each mesh.
  const auto add_copies = [&](const ObjectLists& objects, std::size_t first, const Maps& outer, const auto& object,
                              std::int32_t material, const Flags& flags) {
    std::size_t number = 0;
    for (const auto& item : std::get<ObjectItems<Mesh>>(objects)) {
      for (const MeshCopies& copies : item.data->copies) {
        const GeometryTable& mesh = *groups_[first];
        for (const MeshCopies::Place& place : copies.places) {
          add({static_cast<std::int32_t>(first)},
              from_origin(composed(outer, {item.transform.affine() * place.affine}), mesh.origin_), mesh.bounds_,
              object(number), material, flags.in(item));
          if (has_object_space_) instances_.set_place_in_file(place.affine);
        }
        ++first;
      }
      ++number;
    }
  };
  const auto add_group = [&](const auto& self, const ObjectItem<Instance>& item, const Maps& outer, std::int32_t object,
                             std::int32_t outer_material, const Flags& outer_flags) -> void {
    const std::size_t number = numbers.at(item.parameters.group.name);
    const GeometryTable& group = *groups_[number];
    const Maps maps = composed(outer, item.motion.empty() ? Maps{item.transform.affine()} : item.motion);
    const std::int32_t material = material_number(item, outer_material);
    const Flags flags = outer_flags.in(item);
    if (group.bounds_.lower.x <= group.bounds_.upper.x)
      add({static_cast<std::int32_t>(number)}, from_origin(maps, group.origin_), group.bounds_, object, material,
          flags);
    for (const TransformedShape& shape : group.transformed_) {
      InstanceTarget target = shape.target;
      target.group = static_cast<std::int32_t>(number);
      add(target, composed(maps, {shape.affine}), shape.bounds, object, material, flags);
    }
    add_copies(
        description.groups[number].objects, first_copied_[number + 1], maps, [&](std::size_t) { return object; },
        material, flags);
    for (const auto& inner : std::get<ObjectItems<Instance>>(description.groups[number].objects))
      self(self, inner, maps, object, material, flags);
  };
  const Maps to_origin{Affine{.origin = Vec3d(0, 0, 0) - origin}};
  // First, as the table of parts counts them.
  add_copies(description.objects, first_copied_.front(), to_origin,
             [&](std::size_t mesh) { return geometries_[Shapes::size + mesh].first_object; }, -1, {});
  for (const auto& item : std::get<ObjectItems<Instance>>(description.objects)) {
    add_group(add_group, item, to_origin, static_cast<std::int32_t>(object_materials_.size()), -1, {});
    object_materials_.push_back(std::max(0, material_number(item, -1)));
  }
  for (const TransformedShape& shape : transformed_) {
    const std::int32_t object =
        geometries_[shape.target.shape_type].first_object + static_cast<std::int32_t>(shape.target.primitive);
    add(shape.target, composed(to_origin, {shape.affine}), shape.bounds, object, -1, {});
  }
}

const GeometryTable::TransformedShape* GeometryTable::transformed_shape(const InstanceTarget& target) const {
  if (!target.is_shape) return nullptr;
  for (const TransformedShape& shape : table_of(target).transformed_)
    if (shape.target.shape_type == target.shape_type && shape.target.primitive == target.primitive) return &shape;
  return nullptr;
}

Affine GeometryTable::file_from_instance(std::size_t instance) const {
  const InstanceTarget& target = instances_.target(instance);
  if (const TransformedShape* const shape = transformed_shape(target)) return shape->affine;
  return Affine{.origin = table_of(target).origin_};
}

Bounds GeometryTable::bounds_in_file(std::span<const std::uint8_t> wanted_materials, const Vec3d& origin) const {
  Bounds all = empty_bounds;
  const auto add = [&](const Affine& map, const Bounds& bounds) { all = join(all, transformed_bounds(map, bounds)); };
  const auto add_own = [&](const GeometryTable& table, const Vec3d& its_origin) {
    for (const BoundedObject& object : table.bounded_objects(wanted_materials))
      if (object.object >= 0) add(Affine{.origin = its_origin}, object.bounds);
  };
  add_own(*this, origin);
  for (const BoundedObject& object : bounded_objects(wanted_materials)) {
    if (object.object >= 0) continue;
    const auto instance = static_cast<std::size_t>(-1 - object.object);
    const InstanceTarget& target = instances_.target(instance);
    const Affine map = file_from_instance(instance);
    if (const TransformedShape* const shape = transformed_shape(target))
      add(map, shape->bounds);
    else if (instances_.materials()[instance] >= 0)  // in place of all materials of the group
      add(map, table_of(target).bounds_);
    else
      add_own(table_of(target), table_of(target).origin_);
  }
  return all;
}

std::vector<GeometryTable::PlaceOfGroup> GeometryTable::places_of_groups(
    std::span<const std::uint8_t> wanted_materials) const {
  std::vector<PlaceOfGroup> places;
  for (const BoundedObject& object : bounded_objects(wanted_materials)) {
    if (object.object >= 0) continue;
    const auto instance = static_cast<std::size_t>(-1 - object.object);
    if (instances_.target(instance).group == InstanceTarget::no_group) continue;
    const AffineRecord<float>& map = instances_.world_from_object(instance);
    const Affine world_from_object{Vec3d(map.x), Vec3d(map.y), Vec3d(map.z), Vec3d(map.origin)};
    places.push_back({instance, world_from_object * file_from_instance(instance).inverse()});
  }
  return places;
}

}  // namespace raytrace
