// The shining surfaces of a scene, as what light is drawn from.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "raytrace/scene/geometry_table.h"
#include "raytrace/scene/light_tree.h"
#include "raytrace/scene/patch_sampling.h"
#include "raytrace/scene/surface_interaction.h"

namespace raytrace {

/// What a material sends out.
struct MaterialEmission {
  float radiance = 0;  ///< about that of its channels together; 0: light is not drawn from it
  bool two_sided = false;
};

/// The patches of all surfaces that shine. Planes, and round shapes whose instances stretch them, are not among them:
/// their light counts where a path meets them.
class EmitterTable {
 public:
  /// materials: of all materials by their numbers.
  EmitterTable(const GeometryTable& geometry, std::span<const MaterialEmission> materials, LightSampling sampling);

  bool empty() const { return patches_.empty(); }

  /// A point of a shining surface, for each lane.
  struct Sample {
    PatchSample point;  ///< its density has the choice of the surface in it
    IntN material;
    IntN patch;
  };
  /// Drawn for a point p with a normal of unit length, or 0 on no surface, out of numbers in [0, 1): u chooses the
  /// surface.
  Sample sample(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const FloatN& u, const FloatN& u1,
                const FloatN& u2) const;

  // Patches by their numbers.

  std::size_t size() const { return patches_.size(); }
  const PatchRecord<float>& patch(std::size_t number) const { return patches_[number]; }
  double area(std::size_t number) const;
  /// A point of that patch, drawn as sample_patch() draws it.
  Sample sample(const IntN& patch, const Vec3<FloatN>& from, const FloatN& u1, const FloatN& u2) const;
  /// Whether rays that hit something in those lanes met a patch.
  MaskN has_patch(const Hits& hits, const MaskN& lanes, const Vec3<FloatN>& p) const;

  /// The density, per solid angle, at which sample() for `from` draws what rays hit in those lanes; 0 where it does
  /// not.
  FloatN pdf(const Vec3<FloatN>& from, const Vec3<FloatN>& from_normal, const Hits& hits, const MaskN& lanes,
             const SurfaceInteraction<FloatN>& surface) const;

  /// What rays to a sample's point hit.
  Hits hits(const Sample& sample, const MaskN& lanes) const;

 private:
  /// The patches of primitives of one geometry, one after another.
  struct Range {
    std::uint32_t instance;  ///< its number, as Hits have it
    std::uint32_t geometry;
    std::vector<std::int32_t> primitives;  ///< those that shine, in order
    std::int32_t first_patch;
    std::int32_t patches_each;
    bool is_mesh, is_mirrored;
  };
  /// Where a geometry is, and what its objects are made of.
  struct Setting {
    std::uint32_t instance = 0;
    std::int32_t material = -1;  ///< in place of the objects' own; -1: none
    Affine world_from_object = {};
    double scale = 1;  ///< of all lengths; 0: not of all the same
  };

  struct Primitives {
    std::int32_t first, last;  ///< before that
  };

  void add_table(const GeometryTable& table, const Setting& setting, std::span<const MaterialEmission> materials,
                 std::vector<LightEmission>& emissions);
  void add_geometry(const GeometryTable& table, std::uint32_t geometry, Primitives primitives, const Setting& setting,
                    std::span<const MaterialEmission> materials, std::vector<LightEmission>& emissions);
  /// The number of the patch that each lane's ray hit; -1: none.
  IntN patches_of(const Hits& hits, const MaskN& lanes, const Vec3<FloatN>& p) const;
  /// The same of a lane.
  std::int32_t patch_of(const Hits& hits, std::size_t lane, const Vec3f& p) const;

  std::vector<PatchRecord<float>> patches_;
  std::vector<Range> ranges_;  ///< by instance and geometry
  LightTree tree_;
};

}  // namespace raytrace
