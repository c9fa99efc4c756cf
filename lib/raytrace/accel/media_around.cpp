#include "raytrace/accel/media_around.h"

namespace raytrace {

namespace {

/// Adds those of the media around points whose boundaries a query finds. intersect(rays, lanes): it.
template <class Intersect>
void add_media(const SceneTables& tables, const Accelerator& accelerator, const Vec3<FloatN>& points,
               const MaskN& lanes, MediumStack& around, const Intersect& intersect) {
  constexpr int most_surfaces = 1000;  // where rounding keeps a ray at one
  MediumStack entered;
  // A little aslant, so that it does not run along walls.
  Ray<FloatN> rays{points, Vec3<FloatN>(Vec3f(0.013F, 1, 0.007F)), FloatN(0), infinity<FloatN>()};
  MaskN goes_on = lanes;
  for (int surfaces = 0; surfaces < most_surfaces && any(goes_on); ++surfaces) {
    const Hits hits = intersect(rays, goes_on);
    goes_on = goes_on & hits.hit;
    if (none(goes_on)) break;
    const SurfaceInteraction<FloatN> surface = accelerator.surface(rays, hits);
    const IntN inside = tables.inside(hits);
    const MaskN is_boundary = goes_on & float_mask<FloatN>(inside != IntN(0)), leaves = is_boundary & !surface.front;
    const MaskN entered_here = leaves & entered.contains(inside);
    entered.add(is_boundary & surface.front, inside);
    entered.remove(entered_here, inside);
    around.add_first(leaves & !entered_here, inside);  // what ends farther away is around the rest
    rays.origin = offset_ray_origin(surface, goes_on);
    rays.far = infinity<FloatN>();
  }
}

}  // namespace

MediumStack media_around(const SceneTables& tables, const Accelerator& accelerator, const Vec3<FloatN>& points,
                         const MaskN& lanes, const RayIds* ids, bool camera_sees) {
  MediumStack around;
  const auto add = [&](const auto& intersect) { add_media(tables, accelerator, points, lanes, around, intersect); };
  camera_sees = camera_sees && tables.geometry().has_invisible();
  if (!tables.media().has_fog() && ids == nullptr && !camera_sees) {
    add([&](Ray<FloatN>& rays, const MaskN& left) { return accelerator.intersect(rays, left, Coherence::incoherent); });
    return around;
  }
  const UintN any_number(0u);
  const auto add_what = [&](Meets meets) {
    add([&](Ray<FloatN>& rays, const MaskN& left) {
      RayIdentity identity(tables, accelerator, rays, ids != nullptr ? *ids : RayIds{any_number, any_number, 0});
      identity.meets = meets;
      if (camera_sees) identity.set_seeing(MaskN(true));
      return accelerator.intersect(rays, left, Coherence::incoherent, nullptr, &identity);
    });
  };
  // Fogs apart: they may end at surfaces.
  add_what(Meets::surfaces);
  if (tables.media().has_fog()) add_what(Meets::boundaries_of_fogs);
  return around;
}

}  // namespace raytrace
