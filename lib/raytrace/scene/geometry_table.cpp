#include "raytrace/scene/geometry_table.h"

#include "raytrace/memory/large_array.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

GeometryTable::GeometryTable(const SceneDescription& description, std::span<const std::int32_t> first_materials,
                             int threads) {
  std::size_t count = 0;
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    const auto& items = std::get<ObjectItems<Shape>>(description.objects);
    auto& records = std::get<ShapeTable<Shape>>(tables_).records;
    reserve_large(records, items.size() + 1);  // Embree reads whole 16 byte words of the last vertex
    for (const auto& item : items) records.push_back(Kernel<Shape>::record(item.parameters));
    constexpr std::size_t type = index_of<Shape>(Shapes{});
    first_objects_[type] = static_cast<std::int32_t>(count);
    geometries_[type] = {type, 0, static_cast<std::uint32_t>(items.size()), first_objects_[type]};
    count += items.size();
  });

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

IntN GeometryTable::object(const Hits& hits) const {
  const IntN primitive = select_lanes(hits.hit, hits.primitive, IntN(hits.first_primitive));
  if (hits.one_geometry) return primitive + IntN(first_objects_[hits.first_geometry]);
  const IntN geometry =
      select_lanes(hits.hit, same_bits<IntN>(hits.geometry), IntN(static_cast<std::int32_t>(hits.first_geometry)));
  return primitive + gather(first_objects_.data(), geometry);
}

}  // namespace raytrace
