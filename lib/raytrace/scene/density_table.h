// The densities of fogs that are not the same everywhere, in each place where such a fog is: the world, and each
// instance of a group that has it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/scene/geometry_table.h"
#include "raytrace/scene/instance_table.h"
#include "raytrace/scene/texture_table.h"

namespace raytrace {

/// In one place.
struct Density {
  const DensityGrid* grid;
  AffineRecord<float> lattice_from_world;
  float extinction;       ///< for a unit of length, where the grid has 1
  float most_extinction;  ///< no more of it counts: nothing shines through the distance of two points
};

/// Immutable.
class DensityTable {
 public:
  DensityTable() = default;
  /// Of the fogs among a scene's materials, which are numbered from `first_fog` on. used_materials: 1 for those that
  /// objects have. origin: less which all points of the geometry are. Throws GridError.
  DensityTable(const SceneDescription& description, std::int32_t first_fog,
               const std::vector<std::uint8_t>& used_materials, const GeometryTable& geometry, const Vec3d& origin,
               const TextureTable& textures, int threads);

  bool empty() const { return densities_.empty(); }
  /// Of each material, if it is such a fog: in how many places it is besides the world. Empty if none is.
  const std::vector<std::optional<std::size_t>>& places() const { return places_; }
  /// fog by fog, and of each first the world's.
  const Density& operator[](std::int32_t number) const { return densities_[static_cast<std::size_t>(number)]; }

  /// Whether such fogs are in instances, and the place of each: 0 is the world.
  bool has_instances() const { return !instance_places_.empty(); }
  IntN place(const UintN& instance) const {
    const IntN index = same_bits<IntN>(instance & UintN(~InstanceTable::shape_of_world));
    return gather(instance_places_.data(), index);
  }

 private:
  std::vector<std::shared_ptr<const DensityGrid>> grids_;
  std::vector<Density> densities_;
  std::vector<std::optional<std::size_t>> places_;
  std::vector<std::int32_t> instance_places_;  ///< by the numbers of instances, the first of which is 1
};

}  // namespace raytrace
