// The shining surfaces of a scene, as what light is drawn from.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "raytrace/math/vec2.h"
#include "raytrace/scene/geometry_table.h"
#include "raytrace/scene/instance_maps.h"
#include "raytrace/scene/light_tree.h"
#include "raytrace/scene/patch_sampling.h"
#include "raytrace/scene/surface_interaction.h"

namespace raytrace {

/// What a material sends out.
struct MaterialEmission {
  float radiance = 0;  ///< about that of its channels together; 0: light is not drawn from it
  bool two_sided = false;
  bool textured = false;  ///< whether textures may change it along the surface; then `radiance` is about the most
};

/// The patches of all surfaces that shine. Planes, and cylinders, cones and toruses whose instances stretch them,
/// are not among them: their light counts where a path meets them.
///
/// Flat patches whose texture is not even are cut into up to 4 x 4, each with the power that its part of the texture
/// has, so that the tree draws what is bright and near; on each, points are drawn by what its cells, up to 64 x 64,
/// send out. Round ones are drawn as if they were as bright everywhere.
///
/// Patches of instances that move are kept in the space of their objects, and points are drawn there: for where the
/// point that is lit is in that space at the ray's time. Which patch is drawn does not depend on the time: the tree
/// has what they reach while the shutter is open.
class EmitterTable {
 public:
  /// What lanes of `hits` send out, as MaterialEmission has it, on the mean of a circle of that radius.
  using RadianceAt =
      std::function<FloatN(const Hits& hits, const SurfaceInteraction<FloatN>& surface, const FloatN& radius)>;

  /// materials: of all materials by their numbers; radiance_at: asked of those that are textured.
  EmitterTable(const GeometryTable& geometry, std::span<const MaterialEmission> materials, LightSampling sampling,
               const RadianceAt& radiance_at);

  bool empty() const { return patches_.empty(); }

  /// A point of a shining surface, for each lane.
  struct Sample {
    PatchSample point;  ///< its density has the choice of the surface in it
    IntN material;
    IntN patch;
    FloatN time;
  };
  /// Drawn for a point p with a normal of unit length, or 0 on no surface, out of numbers in [0, 1): u chooses the
  /// surface. time: of the rays, as Hits have it.
  Sample sample(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const FloatN& time, const FloatN& u,
                const FloatN& u1, const FloatN& u2) const;
  /// Whether any patch moves; else times do not count.
  bool has_motion() const { return !movers_.empty(); }

  // Patches by their numbers.

  std::size_t size() const { return patches_.size(); }
  const PatchRecord<float>& patch(std::size_t number) const { return patches_[number]; }
  double area(std::size_t number) const;  ///< of those that move, about that
  /// A point of the world that is on it or in it; of those that move, halfway.
  Vec3d location(std::size_t number) const;
  /// As MaterialEmission has it, on the mean.
  float radiance(std::size_t number) const;
  /// A point of that patch, drawn as sample_patch() draws it.
  Sample sample(const IntN& patch, const Vec3<FloatN>& from, const FloatN& time, const FloatN& u1,
                const FloatN& u2) const;
  /// Points of the patches' own spaces in the world.
  Vec3<FloatN> to_world(const IntN& patch, const FloatN& time, const Vec3<FloatN>& p) const;
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
    std::int32_t cuts = 1;  ///< their faces are cut into so many pieces each way (patch_pieces.h)

    std::int32_t pieces() const { return cuts * cuts; }  ///< of a face
    /// The barycentric coordinates that rays have where a patch's triangle has these, or the other way round.
    Vec2<float> turned(const Vec2<float>& uv, bool is_second) const {
      const Vec2<float> other = is_second ? Vec2<float>{1 - uv.x, 1 - uv.y} : uv;
      return is_mirrored ? Vec2<float>{other.y, other.x} : other;
    }
  };
  /// Where a geometry is, and what its objects are made of.
  struct Setting {
    std::uint32_t instance = 0;
    std::int32_t material = -1;  ///< in place of the objects' own; -1: none
    Affine world_from_object = {};
    double scale = 1;                      ///< of all lengths; 0: not of all the same
    bool is_shape = false;                 ///< it is that of a single shape, whose rays are turned to it
    std::span<const Affine> moments = {};  ///< in place of world_from_object, if it moves
  };
  struct Primitives {
    std::int32_t first, last;  ///< before that
  };
  /// What is known while it is made.
  struct Making {
    std::span<const MaterialEmission> materials;
    const RadianceAt& radiance_at;
    std::int32_t cuts = 1;   ///< of faces whose texture is not even; 0: textures do not count
    std::int32_t cells = 1;  ///< of each piece, each way
    std::vector<LightEmission> emissions = {};
  };
  /// A primitive's patches before they are added.
  struct Faces {
    std::vector<LightPatch> patches;
    std::vector<float> radiances;
    std::int32_t cuts = 1;
    std::vector<float> cells = {};   ///< their radiances, patch by patch, if it is cut
    Affine world_from_patches = {};  ///< halfway, if they move
  };

  /// f(table, geometry, primitives, setting) of all that may shine.
  template <class Function>
  static void for_each_geometry(const GeometryTable& world, std::span<const MaterialEmission> materials,
                                const Function& f);
  static std::int32_t material_of(const GeometryTable& table, std::uint32_t geometry, std::int32_t primitive,
                                  const Setting& setting);
  void add_geometry(const GeometryTable& table, std::uint32_t geometry, Primitives primitives, const Setting& setting,
                    Making& making);
  /// Cuts them where the texture is not even, and sets radiances by it. range: of the primitive.
  static void weigh(Faces& faces, const Range& range, std::int32_t primitive, const MaterialEmission& material,
                    const Making& making);
  /// Of the cells of a face's pieces, piece by piece.
  static std::vector<float> radiances_of(const LightPatch& patch, const Affine& world_from_patch, bool is_second,
                                         const Range& range, std::int32_t primitive, const Making& making);
  /// The number of the patch that each lane's ray hit; -1: none.
  IntN patches_of(const Hits& hits, const MaskN& lanes, const Vec3<FloatN>& p) const;
  /// The same of a lane.
  std::int32_t patch_of(const Hits& hits, std::size_t lane, Vec3f p) const;

  /// The number of the face's piece, counted in it, that was hit at p; face: its first piece; uv: on its triangle.
  std::int32_t piece_of_face(const Range& range, std::int32_t face, const Vec2<float>& uv, const Vec3f& p) const;

  /// Where the patches' own spaces are, and the lanes whose patches move: elsewhere these say nothing.
  struct Places {
    MaskN moves;
    InstanceMaps maps;
  };
  Places places_of(const IntN& patch, const FloatN& time) const;
  /// sample_patch() and patch_pdf() for points in the world, where some patches move.
  PatchSample sample_moving(const PatchRecord<FloatN>& record, const PatchTextures& textures, const Vec3<FloatN>& from,
                            const FloatN& time, const FloatN& u1, const FloatN& u2) const;
  FloatN pdf_of_moving(const PatchRecord<FloatN>& record, const PatchTextures& textures, const Vec3<FloatN>& from,
                       const FloatN& time, const Vec3<FloatN>& p, const Vec3<FloatN>& normal) const;
  const PatchTextures* if_any(const PatchTextures& textures) const { return shares_.empty() ? nullptr : &textures; }
  LightPatch light_patch(std::size_t number) const;
  /// Halfway.
  Affine world_from_patch(std::size_t number) const;

  const InstanceTable* instances_ = nullptr;
  std::vector<PatchRecord<float>> patches_;
  std::vector<std::int32_t> movers_;  ///< of each patch its instance's number, or 0: it stands still; if any moves
  std::vector<float> radiances_;      ///< of patches, if textures count; else of materials
  bool has_own_radiances_ = false;
  PatchShares shares_;         ///< of patches, if any is cut
  std::vector<Range> ranges_;  ///< by instance and geometry
  LightTree tree_;
};

}  // namespace raytrace
