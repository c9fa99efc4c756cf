#include "raytrace/scene/geometry_table.h"

#include <bit>

#include "raytrace/memory/large_array.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

GeometryTable::GeometryTable(const SceneDescription& description, const Vec3d& origin,
                             std::span<const std::int32_t> first_materials, int threads) {
  add_shapes(description, origin);
  std::int32_t objects = geometries_.back().first_object + static_cast<std::int32_t>(geometries_.back().primitives);
  for (const auto& item : std::get<ObjectItems<Mesh>>(description.objects)) {
    const MeshTable& mesh = meshes_.emplace_back(item, origin, first_materials, threads);
    geometries_.push_back({static_cast<std::uint32_t>(mesh.face_count()), objects++, &mesh});
  }
  for (const Geometry& geometry : geometries_) {
    first_objects_.push_back(geometry.first_object);
    primitive_masks_.push_back(geometry.mesh == nullptr ? -1 : 0);
  }
  set_bounding_sphere(threads);
  object_materials_.resize(static_cast<std::size_t>(objects));
  set_object_materials(description, first_materials, threads);
}

void GeometryTable::add_shapes(const SceneDescription& description, const Vec3d& origin) {
  std::int32_t objects = 0;
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    const auto& items = std::get<ObjectItems<Shape>>(description.objects);
    auto& records = std::get<ShapeTable<Shape>>(tables_).records;
    reserve_large(records, items.size() + 1);  // Embree reads whole 16 byte words of the last vertex
    const auto points = point_members<Shape>();
    for (const auto& item : items) {
      typename Shape::Parameters parameters = item.parameters;
      for (const auto point : points) parameters.*point += -origin;
      records.push_back(Kernel<Shape>::record(parameters));
    }
    geometries_.push_back({static_cast<std::uint32_t>(items.size()), objects, nullptr});
    objects += static_cast<std::int32_t>(items.size());
  });
}

void GeometryTable::set_object_materials(const SceneDescription& description,
                                         std::span<const std::int32_t> first_materials, int threads) {
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    const auto& items = std::get<ObjectItems<Shape>>(description.objects);
    const auto first_object = static_cast<std::size_t>(geometries_[index_of<Shape>(Shapes{})].first_object);
    for_each_chunk(items.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const MaterialReference& material = items[i].material;
        object_materials_[first_object + i] =
            first_materials[material.type] + static_cast<std::int32_t>(material.index);
      }
    });
  });
  for (const Geometry& geometry : geometries_)
    if (geometry.mesh != nullptr)
      object_materials_[static_cast<std::size_t>(geometry.first_object)] = geometry.mesh->material(std::size_t{0});
}

std::uint64_t GeometryTable::primitive_count() const {
  std::uint64_t count = 0;
  for (const Geometry& geometry : geometries_) count += geometry.primitives;
  return count;
}

void GeometryTable::set_bounding_sphere(int threads) {
  Bounds all = empty_bounds;
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    if constexpr (requires { &Kernel<Shape>::bounds; }) {
      const auto& records = table<Shape>().records;
      std::vector<Bounds> chunks(chunk_count(records.size()), empty_bounds);
      for_each_chunk(records.size(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          chunks[chunk] = join(chunks[chunk], Kernel<Shape>::bounds(records[i]));
      });
      for (const Bounds& chunk : chunks) all = join(all, chunk);
    }
  });
  for (const MeshTable& mesh : meshes_) all = join(all, mesh.bounds());
  if (all.lower.x > all.upper.x) return;
  const Vec3d lower(all.lower), upper(all.upper);
  bounding_sphere_ = {(lower + upper) * 0.5, length(upper - lower) / 2 * (1 + 1e-6)};
}

std::vector<std::uint8_t> GeometryTable::used_materials(std::int32_t materials) const {
  std::vector<std::uint8_t> used(static_cast<std::size_t>(materials));
  for (const std::int32_t material : object_materials_) used[static_cast<std::size_t>(material)] = 1;
  for (const MeshTable& mesh : meshes_) mesh.add_used_materials(used);
  return used;
}

IntN GeometryTable::object(const Hits& hits) const {
  const IntN primitive = select_lanes(hits.hit, hits.primitive, IntN(hits.first_primitive));
  if (hits.one_geometry) {
    const Geometry& geometry = geometries_[hits.first_geometry];
    return geometry.mesh != nullptr ? IntN(geometry.first_object) : primitive + IntN(geometry.first_object);
  }
  const IntN geometry =
      select_lanes(hits.hit, same_bits<IntN>(hits.geometry), IntN(static_cast<std::int32_t>(hits.first_geometry)));
  return (primitive & gather(primitive_masks_.data(), geometry)) + gather(first_objects_.data(), geometry);
}

std::optional<std::int32_t> GeometryTable::only_material(const Hits& hits) const {
  if (!hits.one_geometry) return std::nullopt;
  const Geometry& geometry = geometries_[hits.first_geometry];
  if (geometry.mesh != nullptr) {
    if (hits.one_primitive) return geometry.mesh->material(static_cast<std::size_t>(hits.first_primitive));
    return geometry.mesh->only_material();
  }
  if (!hits.one_primitive) return std::nullopt;
  return object_materials_[static_cast<std::size_t>(geometry.first_object + hits.first_primitive)];
}

IntN GeometryTable::material(const Hits& hits) const {
  IntN material = gather(object_materials_.data(), object(hits));
  if (meshes_.empty()) return material;
  for (MaskN left = hits.hit; any(left);) {
    const auto first = static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(left)));
    const std::uint32_t geometry = hits.geometry.get(first);
    const MaskN here = left & float_mask<FloatN>(hits.geometry == UintN(geometry));
    left = left & !here;
    const MeshTable* const mesh = geometries_[geometry].mesh;
    if (mesh == nullptr || mesh->only_material()) continue;
    const IntN face = select_lanes(here, hits.primitive, IntN(hits.primitive.get(first)));
    material = select_lanes(here, mesh->material(face), material);
  }
  return material;
}

}  // namespace raytrace
