// Which objects are shadow catchers.
#include <algorithm>
#include <array>

#include "raytrace/math/lanes.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/scene/geometry_table.h"

namespace raytrace {

void GeometryTable::set_shadow_catchers(const ObjectLists& objects, int threads) {
  const auto add = [&](const auto& items, std::int32_t first_object) {
    std::vector<std::vector<std::int32_t>> chunks(chunk_count(items.size()));
    for_each_chunk(items.size(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        if (items[i].shadowcatcher) chunks[chunk].push_back(first_object + static_cast<std::int32_t>(i));
    });
    for (const auto& chunk : chunks) catchers_.insert(catchers_.end(), chunk.begin(), chunk.end());
  };
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    add(std::get<ObjectItems<Shape>>(objects), geometries_[index_of<Shape>(Shapes{})].first_object);
  });
  // Meshes' and clouds' numbers follow each other.
  const auto& meshes = std::get<ObjectItems<Mesh>>(objects);
  const auto& clouds = std::get<ObjectItems<SphereCloud>>(objects);
  const auto behind = static_cast<std::int32_t>(object_materials_.size() - clouds.size());
  add(meshes, behind - static_cast<std::int32_t>(meshes.size()));
  add(clouds, behind);
  has_catchers_ = !catchers_.empty();
}

bool GeometryTable::is_shadow_catcher(std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive) const {
  const GeometryTable* table = this;
  if (instance != 0) {
    const std::size_t i = InstanceTable::index_of(instance);
    if (instances_catch_[i]) return true;
    table = &table_of(instances_.target(i));
  }
  return std::binary_search(table->catchers_.begin(), table->catchers_.end(), table->own_object(geometry, primitive));
}

MaskN GeometryTable::shadow_catchers(const Hits& hits) const {
  alignas(64) std::array<std::uint32_t, packet_lanes> catches{};
  for (const std::size_t lane : SetLanes(hits.hit)) {
    const auto primitive = static_cast<std::uint32_t>(hits.primitive.get(lane));
    catches[lane] = is_shadow_catcher(hits.instance.get(lane), hits.geometry.get(lane), primitive) ? 1 : 0;
    if (hits.one_primitive) return hits.hit & MaskN(catches[lane] != 0);
  }
  return float_mask<FloatN>(UintN::load_aligned(catches.data()) != UintN(0u));
}

}  // namespace raytrace
