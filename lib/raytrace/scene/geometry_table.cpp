#include "raytrace/scene/geometry_table.h"

#include "raytrace/memory/large_array.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

GeometryTable::GeometryTable(const SceneDescription& description, const Vec3d& origin,
                             std::span<const std::int32_t> first_materials, int threads) {
  std::size_t count = 0;
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
    constexpr std::size_t type = index_of<Shape>(Shapes{});
    first_objects_[type] = static_cast<std::int32_t>(count);
    geometries_[type] = {type, 0, static_cast<std::uint32_t>(items.size()), first_objects_[type]};
    count += items.size();
  });

  set_bounding_sphere(threads);
  object_materials_.resize(count);
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    const auto& items = std::get<ObjectItems<Shape>>(description.objects);
    const auto first_object = static_cast<std::size_t>(first_objects_[index_of<Shape>(Shapes{})]);
    for_each_chunk(items.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const MaterialReference& material = items[i].material;
        object_materials_[first_object + i] =
            first_materials[material.type] + static_cast<std::int32_t>(material.index);
      }
    });
  });
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
  if (all.lower.x > all.upper.x) return;
  const Vec3d lower(all.lower), upper(all.upper);
  bounding_sphere_ = {(lower + upper) * 0.5, length(upper - lower) / 2 * (1 + 1e-6)};
}

std::vector<std::uint8_t> GeometryTable::used_materials(std::int32_t materials) const {
  std::vector<std::uint8_t> used(static_cast<std::size_t>(materials));
  for (const std::int32_t material : object_materials_) used[static_cast<std::size_t>(material)] = 1;
  return used;
}

IntN GeometryTable::object(const Hits& hits) const {
  const IntN primitive = select_lanes(hits.hit, hits.primitive, IntN(hits.first_primitive));
  if (hits.one_geometry) return primitive + IntN(first_objects_[hits.first_geometry]);
  const IntN geometry =
      select_lanes(hits.hit, same_bits<IntN>(hits.geometry), IntN(static_cast<std::int32_t>(hits.first_geometry)));
  return primitive + gather(first_objects_.data(), geometry);
}

}  // namespace raytrace
