#include "raytrace/scene/geometry_table.h"

#include <algorithm>

#include "raytrace/math/float_origin.h"
#include "raytrace/math/lanes.h"
#include "raytrace/memory/large_array.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/parameters/transformed.h"

namespace raytrace {

namespace {

constexpr auto sphere_geometry = static_cast<std::uint32_t>(index_of<Sphere>(Shapes{}));

Affine moved(Affine affine, const Vec3d& origin) {
  affine.origin += -origin;
  return affine;
}

/// Of an object far from the origin of its space, a point of it, rounded; else 0.
template <class Shape>
Vec3d own_origin(typename Shape::Parameters parameters, const Fields& points) {
  if constexpr (requires { &Kernel<Shape>::bounds; }) {
    const auto [center, radius] = sphere_around(Kernel<Shape>::bounds(Kernel<Shape>::record(parameters)));
    if (is_coarse(length(center), radius)) return rounded_origin(points.front().get<Vec3d>(&parameters), radius);
  }
  return {0, 0, 0};
}

}  // namespace

GeometryTable::GeometryTable(const ObjectLists& objects, const Vec3d& origin, const MeshMaterials& materials,
                             bool has_object_space, int threads)
    : has_object_space_(has_object_space), origin_(origin) {
  add_objects(objects, origin, materials, threads);
}

GeometryTable::GeometryTable(const SceneDescription& description, const Vec3d& origin, const MeshMaterials& materials,
                             bool has_object_space, int threads)
    : has_object_space_(has_object_space), origin_(origin) {
  add_objects(description.objects, origin, materials, threads);
  for (const Group& group : description.groups)
    groups_.push_back(of_group(group.objects, materials, has_object_space, threads));
  add_copied_meshes(description.objects, materials, threads);
  for (const Group& group : description.groups) add_copied_meshes(group.objects, materials, threads);
  add_instances(description, origin, materials.first);
  for (const auto set : {&GeometryTable::catchers_, &GeometryTable::invisible_})
    for (const auto& group : groups_) (this->*set).has_any |= ((*group).*set).has_any;
}

void GeometryTable::add_objects(const ObjectLists& objects, const Vec3d& origin, const MeshMaterials& materials,
                                int threads) {
  add_shapes(objects, origin);
  std::int32_t count = geometries_.back().first_object + static_cast<std::int32_t>(geometries_.back().primitives);
  for (const auto& item : std::get<ObjectItems<Mesh>>(objects)) {
    const MeshTable& mesh = meshes_.emplace_back(item, origin, materials, threads);
    geometries_.push_back({static_cast<std::uint32_t>(mesh.face_count()), count++, &mesh});
  }
  for (CloudSpheres& cloud : clouds_) cloud.object = count++;
  for (const auto& item : std::get<ObjectItems<Curve>>(objects)) {
    const MaterialReference& material = item.materials.front();
    const CurveTable& curves =
        curves_.emplace_back(item, origin, materials.first[material.type] + static_cast<std::int32_t>(material.index),
                             materials.fibres, threads);
    geometries_.push_back({static_cast<std::uint32_t>(curves.point_count()), count++, nullptr, &curves});
  }
  for (const Geometry& geometry : geometries_) {
    first_objects_.push_back(geometry.first_object);
    primitive_masks_.push_back(geometry.is_one_object() ? 0 : -1);
  }
  set_bounds(threads);
  object_materials_.resize(static_cast<std::size_t>(count));
  set_object_materials(objects, materials.first, threads);
  set_object_sets(objects, threads);
}

void GeometryTable::add_shapes(const ObjectLists& objects, const Vec3d& origin) {
  std::int32_t count = 0;
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    constexpr std::uint32_t type = index_of<Shape>(Shapes{});
    const auto& items = std::get<ObjectItems<Shape>>(objects);
    auto& [records, instanced, uv_frames] = std::get<ShapeTable<Shape>>(tables_);
    reserve_large(records, items.size() + 1);  // Embree reads whole 16 byte words of the last vertex
    const Fields points = point_fields<Shape>();
    const auto record_less = [&](typename Shape::Parameters parameters, const Vec3d& less) {
      for (const Field& point : points) point.get<Vec3d>(&parameters) += -less;
      return Kernel<Shape>::record(parameters);
    };
    for (const auto& item : items) {
      const Affine affine = item.transform.affine();
      const auto shape =
          item.transform.empty() ? std::optional(item.parameters) : transformed<Shape>(item.parameters, affine);
      if (shape) {
        const Affine here = moved(affine, origin);
        if (has_object_space_ ? !here.is_identity() : !keeps_uv<Shape>(here)) {
          const Vec3d own = own_origin<Shape>(item.parameters, points);
          uv_frames.add(records.size(), items.size(), record_less(item.parameters, own), here, own);
        }
        records.push_back(record_less(*shape, origin));
        continue;
      }
      const Vec3d own = own_origin<Shape>(item.parameters, points);
      if (has_object_space_ && length(own) > 0)
        uv_frames.add(records.size(), items.size(), record_less(item.parameters, own), Affine{.origin = -own}, own);
      records.push_back(record_less(item.parameters, own));
      if constexpr (requires { &Kernel<Shape>::bounds; }) {
        const auto number = static_cast<std::uint32_t>(records.size() - 1);
        instanced.resize(items.size());
        instanced[number] = true;
        transformed_.push_back({{InstanceTarget::no_group, true, type, number},
                                affine * Affine{.origin = own},
                                Kernel<Shape>::bounds(records.back())});
      }
    }
    if constexpr (std::is_same_v<Shape, Sphere>) add_clouds(std::get<ObjectItems<SphereCloud>>(objects), origin);
    geometries_.push_back({static_cast<std::uint32_t>(records.size()), count});
    count += static_cast<std::int32_t>(items.size());
  });
}

void GeometryTable::add_clouds(const std::vector<ObjectItem<SphereCloud>>& clouds, const Vec3d& origin) {
  auto& [records, instanced, uv_frames] = std::get<ShapeTable<Sphere>>(tables_);
  std::size_t count = records.size();
  for (const auto& cloud : clouds) count += cloud.data->size();
  reserve_large(records, count);
  for (const auto& cloud : clouds) {
    const PointCloud& data = *cloud.data;
    const auto first = static_cast<std::int32_t>(records.size());
    const Affine affine = cloud.transform.affine();
    const double scale = cloud.transform.empty() ? 1 : affine.uniform_scale().value_or(1);
    for (std::size_t i = 0; i < data.size(); ++i) {
      const float* const p = data.positions.data() + 3 * i;
      const double radius = data.radii.empty() ? cloud.parameters.radius : static_cast<double>(data.radii[i]);
      Vec3d center = Vec3d(p[0], p[1], p[2]) + data.origin;
      if (!cloud.transform.empty()) center = affine.point(center);
      records.push_back(Kernel<Sphere>::record({center + -origin, radius * scale}));
    }
    clouds_.push_back(
        {first, static_cast<std::int32_t>(records.size()), 0, cloud.data, to_float(moved(affine, origin).inverse())});
  }
  if (!instanced.empty()) instanced.resize(records.size());
  if (!uv_frames.empty()) uv_frames.of_object.resize(records.size(), -1);
}

void GeometryTable::set_object_materials(const ObjectLists& objects, std::span<const std::int32_t> first_materials,
                                         int threads) {
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    const auto& items = std::get<ObjectItems<Shape>>(objects);
    const auto first_object = static_cast<std::size_t>(geometries_[index_of<Shape>(Shapes{})].first_object);
    for_each_chunk(items.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const MaterialReference& material = items[i].material;
        object_materials_[first_object + i] =
            first_materials[material.type] + static_cast<std::int32_t>(material.index);
      }
    });
  });
  objects_have_one_material_ =
      std::all_of(meshes_.begin(), meshes_.end(), [](const MeshTable& mesh) { return mesh.only_material(); });
  for (const Geometry& geometry : geometries_)
    if (geometry.mesh != nullptr)
      object_materials_[static_cast<std::size_t>(geometry.first_object)] = geometry.mesh->material(std::size_t{0});
    else if (geometry.curves != nullptr)
      object_materials_[static_cast<std::size_t>(geometry.first_object)] = geometry.curves->material();
  for (std::size_t i = 0; i < clouds_.size(); ++i) {
    const MaterialReference& material = std::get<ObjectItems<SphereCloud>>(objects)[i].materials.front();
    object_materials_[static_cast<std::size_t>(clouds_[i].object)] =
        first_materials[material.type] + static_cast<std::int32_t>(material.index);
  }
}

std::uint64_t GeometryTable::primitive_count() const {
  std::uint64_t count = instances_.size();
  for (const Geometry& geometry : geometries_) count += geometry.primitives;
  for (const auto& group : groups_) count += group->primitive_count();
  return count;
}

void GeometryTable::set_bounds(int threads) {
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    if constexpr (requires { &Kernel<Shape>::bounds; }) {
      const auto& records = table<Shape>().records;
      std::vector<Bounds> chunks(chunk_count(records.size()), empty_bounds);
      for_each_chunk(records.size(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          if (!table<Shape>().is_instanced(i)) chunks[chunk] = join(chunks[chunk], Kernel<Shape>::bounds(records[i]));
      });
      for (const Bounds& chunk : chunks) bounds_ = join(bounds_, chunk);
    }
  });
  for (const MeshTable& mesh : meshes_) bounds_ = join(bounds_, mesh.bounds());
  for (const CurveTable& curves : curves_) bounds_ = join(bounds_, curves.bounds());
}

BoundingSphere GeometryTable::bounding_sphere() const {
  Bounds all = bounds_;
  for (std::size_t i = 0; i < instances_.size(); ++i) all = join(all, instances_.bounds(i));
  if (all.lower.x > all.upper.x) return {{0, 0, 0}, -1};
  BoundingSphere sphere = sphere_around(all);
  sphere.radius *= 1 + 1e-6;
  return sphere;
}

std::vector<GeometryTable::BoundedObject> GeometryTable::bounded_objects(
    std::span<const std::uint8_t> wanted_materials) const {
  std::vector<BoundedObject> objects;
  const auto is_wanted = [&](std::int32_t material) {
    return wanted_materials[static_cast<std::size_t>(material)] != 0;
  };
  const auto has_wanted = [&](const std::vector<std::uint8_t>& used) {
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i] != 0 && wanted_materials[i] != 0) return true;
    return false;
  };
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    if constexpr (requires { &Kernel<Shape>::bounds; }) {
      constexpr auto type = static_cast<std::uint32_t>(index_of<Shape>(Shapes{}));
      const ShapeTable<Shape>& shapes = table<Shape>();
      for (std::size_t i = 0; i < shapes.records.size(); ++i) {
        if (shapes.is_instanced(i) || !is_wanted(own_material(type, static_cast<std::uint32_t>(i)))) continue;
        const IntN object = this->object(type, IntN(static_cast<std::int32_t>(i)));
        objects.push_back({Kernel<Shape>::bounds(shapes.records[i]),
                           raytrace::bounding_radius<Shape>(shapes.records[i]), object.get(0), type});
      }
    }
  });
  const auto geometries = static_cast<std::uint32_t>(geometries_.size());
  for (std::uint32_t i = 0; i < geometries; ++i) {
    const auto& [primitives, first_object, mesh, curves] = geometries_[i];
    if (curves != nullptr && is_wanted(curves->material()))
      objects.push_back({curves->bounds(), curves->bounding_radius(), first_object, i});
    if (mesh == nullptr) continue;
    std::vector<std::uint8_t> used(wanted_materials.size());
    mesh->add_used_materials(used);
    if (has_wanted(used)) objects.push_back({mesh->bounds(), mesh->bounding_radius(), first_object, i});
  }
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const InstanceTarget& target = instances_.target(i);
    const std::int32_t instead = instances_.materials()[i];
    const GeometryTable& table = table_of(target);
    const auto count = static_cast<std::int32_t>(wanted_materials.size());
    const bool has = instead >= 0      ? is_wanted(instead)
                     : target.is_shape ? is_wanted(table.own_material(target.shape_type, target.primitive))
                                       : has_wanted(table.used_materials(count));
    const Bounds bounds = instances_.bounds(i);
    if (has) objects.push_back({bounds, sphere_around(bounds).radius, -1 - static_cast<std::int32_t>(i), geometries});
  }
  return objects;
}

std::vector<std::uint8_t> GeometryTable::used_materials(std::int32_t materials) const {
  std::vector<std::uint8_t> used(static_cast<std::size_t>(materials));
  const auto add = [&](const GeometryTable& table) {
    // Instances of empty groups may be of a material in a scene that has none.
    for (const std::int32_t material : table.object_materials_)
      if (material < materials) used[static_cast<std::size_t>(material)] = 1;
    for (const MeshTable& mesh : table.meshes_) mesh.add_used_materials(used);
  };
  add(*this);
  for (const auto& group : groups_) add(*group);
  for (const std::int32_t material : instances_.materials())
    if (material >= 0) used[static_cast<std::size_t>(material)] = 1;
  return used;
}

IntN GeometryTable::or_cloud(const IntN& object, const IntN& sphere, const MaskN& lanes) const {
  IntN result = object;
  for_each_cloud(sphere, lanes, [&](const CloudSpheres& cloud, const MaskN& here) {
    result = select_lanes(here, IntN(cloud.object), result);
  });
  return result;
}

IntN GeometryTable::object(std::uint32_t geometry, const IntN& primitive) const {
  const std::int32_t first_object = geometries_[geometry].first_object;
  if (geometries_[geometry].is_one_object()) return IntN(first_object);
  const IntN single = primitive + IntN(first_object);
  return geometry == sphere_geometry ? or_cloud(single, primitive, MaskN(true)) : single;
}

IntN GeometryTable::object(const Hits& hits) const {
  const IntN primitive = select_lanes(hits.hit, hits.primitive, IntN(hits.first_primitive));
  if (hits.one_geometry) return object(hits.first_geometry, primitive);
  // Lanes without hits follow the first with one; instances', geometry 0.
  MaskN in_world = hits.hit;
  if (hits.in_instances) in_world = in_world & float_mask<FloatN>(hits.instance == UintN(0u));
  const IntN other(hits.in_instances ? 0 : static_cast<std::int32_t>(hits.first_geometry));
  const IntN geometry = select_lanes(in_world, same_bits<IntN>(hits.geometry), other);
  IntN own = (primitive & gather(primitive_masks_.data(), geometry)) + gather(first_objects_.data(), geometry);
  if (!clouds_.empty())
    own = or_cloud(own, primitive, float_mask<FloatN>(geometry == IntN(static_cast<std::int32_t>(sphere_geometry))));
  return hits.in_instances ? select_lanes(hits.hit & !in_world, instances_.object(hits.instance), own) : own;
}

std::optional<std::int32_t> GeometryTable::only_material(const Hits& hits) const {
  if (!hits.one_geometry) return std::nullopt;
  if (hits.one_primitive) return own_material(hits.first_geometry, static_cast<std::uint32_t>(hits.first_primitive));
  const Geometry& geometry = geometries_[hits.first_geometry];
  if (geometry.curves != nullptr) return geometry.curves->material();
  return geometry.mesh != nullptr ? geometry.mesh->only_material() : std::nullopt;
}

std::int32_t GeometryTable::own_material(std::uint32_t geometry, std::uint32_t primitive) const {
  if (const MeshTable* const mesh = geometries_[geometry].mesh; mesh != nullptr)
    return mesh->material(std::size_t{primitive});
  return object_materials_[static_cast<std::size_t>(own_object(geometry, primitive))];
}

std::int32_t GeometryTable::own_object(std::uint32_t geometry, std::uint32_t primitive) const {
  const std::int32_t first_object = geometries_[geometry].first_object;
  if (geometries_[geometry].is_one_object()) return first_object;
  const auto number = static_cast<std::int32_t>(primitive);
  const bool in_cloud = geometry == sphere_geometry && !clouds_.empty();
  return in_cloud ? object(geometry, IntN(number)).get(0) : first_object + number;
}

std::int32_t GeometryTable::material_of(std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive) const {
  const GeometryTable* table = this;
  if (instance != 0) {
    const std::size_t i = InstanceTable::index_of(instance);
    if (instances_.materials()[i] >= 0) return instances_.materials()[i];
    table = &table_of(instances_.target(i));
  }
  return table->own_material(geometry, primitive);
}

IntN GeometryTable::material(const Hits& hits) const {
  if (objects_have_one_material_ && !hits.in_instances) return gather(object_materials_.data(), object(hits));
  IntN material(0);
  for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t index, const MaskN& here) {
    const std::size_t first = first_lane(here);
    const IntN primitive = select_lanes(here, hits.primitive, IntN(hits.primitive.get(first)));
    const Geometry& geometry = table.geometries_[index];
    const IntN of_geometry = geometry.mesh != nullptr
                                 ? geometry.mesh->material(primitive)
                                 : gather(table.object_materials_.data(), table.object(index, primitive));
    material = select_lanes(here, of_geometry, material);
  });
  if (hits.in_instances) {
    const IntN instead = instances_.material(hits.instance);
    const MaskN has = float_mask<FloatN>(hits.instance != UintN(0u)) & float_mask<FloatN>(instead >= IntN(0));
    material = select_lanes(has, instead, material);
  }
  return material;
}

}  // namespace raytrace
