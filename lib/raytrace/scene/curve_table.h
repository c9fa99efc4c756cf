// Curves as the tracer reads them: the pieces of strands, and what shading takes from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "raytrace/description/scene_description.h"
#include "raytrace/import/curve_data.h"
#include "raytrace/math/affine.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/scene/hits.h"
#include "raytrace/scene/instance_table.h"
#include "raytrace/scene/surface_interaction.h"
#include "raytrace/shapes/round_cone.h"

namespace raytrace {

/// Piece i is from point i to the next one; the last points of strands have none.
///
/// The surface of a strand is that of the union of its pieces: what is inside of a neighbour is none. So closed strands
/// of glass or fog have one boundary, and rays within a strand meet nothing but its outside.
class CurveTable {
 public:
  /// origin: as GeometryTable's. fibres: of each material, 1 if curves of it are hit from outside alone; empty: none
  /// is.
  CurveTable(const ObjectItem<Curve>& curve, const Vec3d& origin, std::int32_t material,
             std::span<const std::uint8_t> fibres, int threads);

  std::size_t point_count() const { return data_->size(); }
  bool has_piece(std::size_t i) const { return i + 1 < point_count() && !is_root(i + 1); }
  std::int32_t material() const { return material_; }
  /// To where its points lay in its file.
  const AffineRecord<float>& object_from_world() const { return object_from_world_; }
  Bounds piece_bounds(std::size_t piece) const { return cone(piece).bounds(); }
  const Bounds& bounds() const { return bounds_; }
  double bounding_radius() const { return sphere_around(bounds_).radius; }

  /// The nearest distance inside (ray.near, ray.far) in each lane of `active`; infinity elsewhere. u: where that is, as
  /// a share of the piece. instead: the material in place of its own, or -1.
  template <class F>
  F intersect(std::uint32_t piece, const Ray<F>& ray, const Mask<F>& active, std::int32_t instead, F& u) const;

  /// Where rays end: p, error, ng, ns and front, of lanes that hit a piece.
  void set_surface(const IntN& pieces, const Ray<FloatN>& rays, const MaskN& lanes,
                   SurfaceInteraction<FloatN>& result) const;

  /// u: along the strand, from the root to the tip, by its length. v: around it, such that u, v and the outside are
  /// right-handed, from its lowest place at the root; it does not turn with the strand. At points of the surface.
  SurfaceUv<FloatN> uv(const IntN& pieces, const Vec3<FloatN>& position, const MaskN& lanes) const;

  bool has_colors() const { return !data_->colors.empty(); }
  /// share: Hits' u.
  Rgb<FloatN> color(const IntN& pieces, const FloatN& share, const MaskN& lanes) const;

 private:
  /// A point of the surface, and of the curve.
  struct Place {
    RoundCone cone;
    Vec3d normal;         ///< of the piece
    Vec3d smooth_normal;  ///< of the curve
    Vec3d tangent;        ///< of the curve, towards the tip
    Vec3d position;
    double share;  ///< of the piece
    double radius;
  };

  const float* points() const { return moved_.empty() ? data_->points.data() : moved_.data(); }
  Vec3d point(std::size_t i) const {
    const float* const p = points() + 4 * i;
    return {p[0], p[1], p[2]};
  }
  double radius(std::size_t i) const { return points()[4 * i + 3]; }
  bool is_root(std::size_t i) const { return data_->along[i] == 0; }
  /// Whether such pieces are of one strand: there is one before, or behind, a piece.
  bool has_before(std::size_t piece) const { return !is_root(piece); }
  bool has_behind(std::size_t piece) const { return has_piece(piece + 1); }
  RoundCone cone(std::size_t piece) const {
    return RoundCone::between(point(piece), radius(piece), point(piece + 1), radius(piece + 1));
  }
  bool is_fibre(std::int32_t instead) const {
    return !fibres_.empty() && fibres_[static_cast<std::size_t>(instead >= 0 ? instead : material_)] != 0;
  }
  Place place(std::size_t piece, const Vec3d& p) const;
  /// Of the curve, where a piece begins or ends, whose own direction is given.
  Vec3d tangent_at(std::size_t point, const Vec3d& of_piece) const;
  /// Whether points lie in pieces next to one, or a few further on, which may reach as far.
  template <class D>
  auto in_neighbours(std::size_t piece, const Vec3<D>& p) const;
  void move(const Affine& affine, double scale, int threads);
  void set_turns();

  std::shared_ptr<const CurveData> data_;
  MeshBuffer<float> moved_;   ///< points, if they are not the data's
  std::vector<float> turns_;  ///< of each piece: where v begins, in turns about its axis
  std::int32_t material_;
  std::vector<std::uint8_t> fibres_;
  Bounds bounds_ = empty_bounds;
  AffineRecord<float> object_from_world_;
};

template <class D>
RAYTRACE_INLINE auto CurveTable::in_neighbours(std::size_t piece, const Vec3<D>& p) const {
  // Of pieces shorter than they are thick, more than the next may reach here.
  constexpr std::size_t most = 8;
  const double size = std::max(radius(piece), radius(piece + 1));
  const auto reaches = [&](std::size_t near_end, std::size_t far_end, std::size_t own_end) {
    return length(point(near_end) - point(own_end)) < size + std::max(radius(near_end), radius(far_end));
  };
  auto inside = D(0.0) > D(0.0);
  for (std::size_t i = piece, k = 0; k < most && has_before(i) && (k == 0 || reaches(i, i - 1, piece)); ++k, --i)
    inside = inside | cone(i - 1).template contains<D>(p);
  for (std::size_t i = piece, k = 0; k < most && has_behind(i) && (k == 0 || reaches(i + 1, i + 2, piece + 1));
       ++k, ++i)
    inside = inside | cone(i + 1).template contains<D>(p);
  return inside;
}

template <class F>
RAYTRACE_INLINE F CurveTable::intersect(std::uint32_t piece, const Ray<F>& ray, const Mask<F>& active,
                                        std::int32_t instead, F& u) const {
  using D = Doubles<F>;
  const RoundCone cone = this->cone(piece);
  const Vec3<D> origin(ray.origin), direction(ray.direction);
  const auto near_enough = passes_near<D>(cone, origin, direction);
  if (none(active & D::float_mask(near_enough))) return infinity<F>();
  const RoundConeStretch<D> stretch(cone, origin, direction);
  const D near(ray.near), far(ray.far), infinite(std::numeric_limits<double>::infinity());
  const auto meets = near_enough & (stretch.entry <= stretch.exit);
  const auto enters = meets & (stretch.entry > near) & (stretch.entry < far);
  auto leaves = meets & (stretch.exit > near) & (stretch.exit < far);
  if (is_fibre(instead)) leaves = D(0.0) > D(0.0);
  if (none(active & D::float_mask(enters | leaves))) return infinity<F>();
  // The sphere that it shares is that of the piece before.
  const D shared(has_before(piece) ? 1.0 : 0.0);
  const auto visible = [&](const auto& candidates, const D& t, const auto& on_start) {
    const auto hidden = (on_start & (shared > D(0.0))) | in_neighbours<D>(piece, origin + direction * t);
    return select(candidates, select(hidden, infinite, t), infinite);
  };
  D t = visible(enters, stretch.entry, stretch.enters_start);
  const auto needs_exit = leaves & (t >= infinite);
  if (any(needs_exit)) t = min(t, visible(needs_exit, stretch.exit, stretch.leaves_start));
  const Vec3<D> from = origin + direction * t - Vec3<D>(cone.start);
  const Vec3<D> axis(cone.axis);
  const D height = dot(from, axis);
  const D foot = min(max(height - length(from - axis * height) * D(cone.sine / cone.cosine), D(cone.first_foot)),
                     D(cone.last_foot));
  u = (foot * D(cone.length > 0 ? 1 / cone.length : 0)).to_float();
  return select(active, t.to_float(), infinity<F>());
}

}  // namespace raytrace
