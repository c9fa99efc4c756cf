// The parts of meshes, such as the nodes of a glTF file, for ids of what was hit.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/simd.h"
#include "raytrace/scene/hits.h"

namespace raytrace {

/// Which part of which mesh has which number.
class PartTable {
 public:
  explicit PartTable(const SceneDescription& description);

  /// object: of each lane that hit something, its number. The result is that, or in lanes that hit a mesh with parts
  /// the number of the part: they are counted behind all objects, mesh by mesh. Meshes in groups have none.
  IntN part_or_object(const Hits& hits, const IntN& object) const;

 private:
  struct Parts {
    std::int32_t object;  ///< the mesh's number
    std::int32_t first;   ///< the first part's
    std::shared_ptr<const MeshData> mesh;
  };

  std::vector<Parts> meshes_;  ///< those that have any, in the order of their numbers
  /// Of all copies of meshes in the world, the part among its mesh's. Their instances come first, in this order
  /// (GeometryTable::add_instances()).
  std::vector<std::uint32_t> parts_of_copies_;
};

}  // namespace raytrace
