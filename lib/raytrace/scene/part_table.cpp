#include "raytrace/scene/part_table.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "raytrace/math/lanes.h"

namespace raytrace {

PartTable::PartTable(const SceneDescription& description) {
  std::int32_t objects = 0, parts = 0;
  for_each_type(Objects{}, [&]<class Object>(std::type_identity<Object>) {
    for (const auto& item : std::get<ObjectItems<Object>>(description.objects)) {
      if constexpr (std::is_same_v<Object, Mesh>) {
        if (!item.data->parts.empty()) meshes_.push_back({objects, parts, item.data});
        for (const MeshCopies& copies : item.data->copies)
          for (const MeshCopies::Place& place : copies.places) parts_of_copies_.push_back(place.part);
        parts += static_cast<std::int32_t>(item.data->parts.size());
      }
      ++objects;
    }
  });
  for (Parts& mesh : meshes_) mesh.first += objects;
}

IntN PartTable::part_or_object(const Hits& hits, const IntN& object) const {
  if (meshes_.empty()) return object;
  alignas(64) std::array<std::int32_t, packet_lanes> numbers;
  object.store_aligned(numbers.data());
  for (const std::size_t lane : SetLanes(hits.hit)) {
    const auto found = std::ranges::lower_bound(meshes_, numbers[lane], {}, &Parts::object);
    if (found == meshes_.end() || found->object != numbers[lane]) continue;
    if (const std::uint32_t instance = hits.in_instances ? hits.instance.get(lane) : 0; instance != 0) {
      numbers[lane] = found->first + static_cast<std::int32_t>(parts_of_copies_[InstanceTable::index_of(instance)]);
      continue;
    }
    const auto face = static_cast<std::size_t>(hits.primitive.get(lane));
    const std::vector<MeshPart>& parts = found->mesh->parts;
    const auto behind = std::ranges::upper_bound(parts, face, {}, &MeshPart::first_face);
    numbers[lane] = found->first + static_cast<std::int32_t>(behind - parts.begin()) - 1;
  }
  return IntN::load_aligned(numbers.data());
}

}  // namespace raytrace
