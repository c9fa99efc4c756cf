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
  /// So many mean free paths on the way from one point of the lattice to the next, or on all of a ray's way in the fog
  /// if that is shorter, are as good as any more.
  static constexpr float most_depth = 1000;

  const DensityGrid* grid;
  AffineRecord<float> lattice_from_world;
  float extinction;       ///< for a unit of length, where the grid has 1
  float most_extinction;  ///< that of most_depth between points
};

/// Immutable.
class DensityTable {
 public:
  DensityTable() = default;
  /// Of the fogs among a scene's materials, which are numbered from `first_fog` on. used_materials: 1 for those that
  /// objects have. origin: less which all points of the geometry are. Throws GridError, and RenderError if fogs are in
  /// more places than media have numbers.
  DensityTable(const SceneDescription& description, std::int32_t first_fog,
               const std::vector<std::uint8_t>& used_materials, const GeometryTable& geometry, const Vec3d& origin,
               const TextureTable& textures, int threads);

  bool empty() const { return densities_.empty(); }
  /// Of each material, if it is such a fog: in how many places it is besides the world. Empty if none is.
  const std::vector<std::optional<std::size_t>>& places() const { return places_; }
  /// fog by fog, and of each first the world's.
  const Density& operator[](std::int32_t number) const { return densities_[static_cast<std::size_t>(number)]; }

  /// Whether such fogs are in instances, and the place that each has there: 0 is the world. In lanes with such a
  /// fog's material; in others 0.
  bool has_instances() const { return !first_places_.empty(); }
  IntN place(const MaskN& lanes, const IntN& material, const UintN& instance) const {
    const UintN number = select_lanes(lanes, instance & UintN(~InstanceTable::shape_of_world), UintN(0U));
    const IntN index = same_bits<IntN>(number), fog = select_lanes(lanes, material - IntN(first_fog_), IntN(0));
    const IntN first = gather(first_places_.data(), gather(kinds_.data(), index) * IntN(fogs_) + fog);
    return first + gather(ranks_.data(), index);
  }

 private:
  using WorldFromPlaces = std::vector<Affine>;
  std::vector<WorldFromPlaces> find_places(const std::vector<std::uint8_t>& uneven, const GeometryTable& geometry,
                                           const Affine& world_from_file);

  std::vector<std::shared_ptr<const DensityGrid>> grids_;
  std::vector<Density> densities_;
  std::vector<std::optional<std::size_t>> places_;
  // Instances with the same fogs are of one kind. A fog's places are kind by kind, and in the order of instances.
  std::int32_t first_fog_ = 0, fogs_ = 0;
  std::vector<std::int32_t> kinds_, ranks_;  ///< by the numbers of instances, the first of which is 1; of kind 0: none
  std::vector<std::int32_t> first_places_;   ///< of each fog in each kind; kind by kind
};

}  // namespace raytrace
