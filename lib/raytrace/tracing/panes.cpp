#include "raytrace/tracing/panes.h"

#include <optional>

#include "raytrace/accel/surface_uv.h"

namespace raytrace {

Rgb<FloatN> light_through_panes(const TracedScene& scene, const Ray<FloatN>& rays, const MaskN& lanes,
                                const RayIds& ids, const PanesAhead& panes) {
  // No more than where rounding keeps a ray at one.
  const IntN most = select_lanes(float_mask<FloatN>(panes.most < IntN(1000)), panes.most, IntN(1000));
  constexpr float before_end = 1 - 0x1p-16F;  // more than what rounding makes of a pane at the light itself
  const SceneTables& tables = scene.tables();
  const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
  const Vec3<FloatN> way = normalize(rays.direction);
  const FloatN reach = rays.far * FloatN(before_end), unit = length(rays.direction);
  Rgb<FloatN> light(Rgb<float>(1, 1, 1));
  Ray<FloatN> left = rays;
  left.near = FloatN(0);
  FloatN begin(0);
  MaskN goes_on = lanes;
  for (int crossed = 0; any(goes_on); ++crossed) {
    left.far = reach - begin;
    RayIdentity identity(tables, scene.accelerator(), left, ids);
    identity.meets = Meets::panes;
    Hits hits = scene.accelerator().intersect(left, goes_on & (left.far > FloatN(0)), Coherence::incoherent, nullptr,
                                              &identity);
    goes_on = goes_on & hits.hit;
    if (none(goes_on)) break;
    const MaskN too_many = goes_on & float_mask<FloatN>(most < IntN(crossed + 1));
    light = select(too_many, black, light);
    goes_on = goes_on & !too_many;
    if (none(goes_on)) break;
    if (tables.has_motion()) [[unlikely]]
      hits.time = ids.times();
    const SurfaceInteraction<FloatN> surface = scene.accelerator().surface(left, hits);
    begin = select(goes_on, begin + left.far, begin);
    std::optional<TexturePoint<FloatN>> point;
    if (tables.has_textures(hits)) {
      SurfaceInteraction<FloatN> in_view = surface;
      in_view.wo = -way;
      point = texture_point(tables, tables.ray_cone().half_width(panes.distance + begin * unit), hits, in_view);
    }
    const FloatN cosine = -dot(way, surface.ns);
    const Vec3<FloatN> wo{sqrt(max(FloatN(1) - cosine * cosine, FloatN(0))), FloatN(0), cosine};
    const Rgb<FloatN> through = tables.straight(hits, panes.around, wo, point ? &*point : nullptr);
    // One that turns its shading normal away lets paths go elsewhere.
    light = select(goes_on, select(cosine > FloatN(1e-4F), light * through, black), light);
    left.origin = select(goes_on, offset_ray_origin(surface, goes_on), left.origin);
  }
  return light;
}

}  // namespace raytrace
