// Which objects are shadow catchers, and which are not visible to the camera.
#include <algorithm>
#include <array>

#include "raytrace/math/lanes.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/scene/geometry_table.h"

namespace raytrace {

void GeometryTable::set_object_sets(const ObjectLists& objects, int threads) {
  const auto set_all = [&](ObjectSet& set, const auto& is_in_set) {
    const auto add = [&](const auto& items, std::int32_t first_object) {
      std::vector<std::vector<std::int32_t>> chunks(chunk_count(items.size()));
      for_each_chunk(items.size(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          if (is_in_set(items[i])) chunks[chunk].push_back(first_object + static_cast<std::int32_t>(i));
      });
      for (const auto& chunk : chunks) set.objects.insert(set.objects.end(), chunk.begin(), chunk.end());
    };
    for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
      add(std::get<ObjectItems<Shape>>(objects), geometries_[index_of<Shape>(Shapes{})].first_object);
    });
    // The numbers of meshes, clouds and curves follow each other.
    const auto& meshes = std::get<ObjectItems<Mesh>>(objects);
    const auto& clouds = std::get<ObjectItems<SphereCloud>>(objects);
    const auto& curves = std::get<ObjectItems<Curve>>(objects);
    const auto first_curve = static_cast<std::int32_t>(object_materials_.size() - curves.size());
    const auto first_cloud = first_curve - static_cast<std::int32_t>(clouds.size());
    add(meshes, first_cloud - static_cast<std::int32_t>(meshes.size()));
    add(clouds, first_cloud);
    add(curves, first_curve);
    set.has_any = !set.objects.empty();
  };
  set_all(catchers_, [](const auto& item) { return item.shadowcatcher; });
  set_all(invisible_, [](const auto& item) { return !item.visible; });
}

bool GeometryTable::is_of(ObjectSet GeometryTable::* set, std::uint32_t instance, std::uint32_t geometry,
                          std::uint32_t primitive) const {
  const GeometryTable* table = this;
  if (instance != 0) {
    const std::size_t i = InstanceTable::index_of(instance);
    if ((this->*set).instances[i]) return true;
    table = &table_of(instances_.target(i));
  }
  const std::vector<std::int32_t>& objects = (table->*set).objects;
  return std::binary_search(objects.begin(), objects.end(), table->own_object(geometry, primitive));
}

MaskN GeometryTable::lanes_of(ObjectSet GeometryTable::* set, const Hits& hits) const {
  alignas(64) std::array<std::uint32_t, packet_lanes> is_in_set{};
  for (const std::size_t lane : SetLanes(hits.hit)) {
    const auto primitive = static_cast<std::uint32_t>(hits.primitive.get(lane));
    is_in_set[lane] = is_of(set, hits.instance.get(lane), hits.geometry.get(lane), primitive) ? 1 : 0;
    if (hits.one_primitive) return hits.hit & MaskN(is_in_set[lane] != 0);
  }
  return float_mask<FloatN>(UintN::load_aligned(is_in_set.data()) != UintN(0u));
}

}  // namespace raytrace
