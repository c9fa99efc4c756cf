// Tangents of materials whose reflection differs along the surface.
#include "raytrace/math/turns.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

namespace {

/// A map's tangent, x along u and y along v, of unit length. Where it has none it is along u.
Vec2<FloatN> mapped_tangent(const Rgb<FloatN>& map) {
  const FloatN x = map.red * FloatN(2) - FloatN(1), y = map.green * FloatN(2) - FloatN(1);
  const FloatN size = sqrt(x * x + y * y);
  const MaskN has_direction = size > FloatN(0.01F);  // bytes have no 1/2
  const FloatN scale = FloatN(1) / select(has_direction, size, FloatN(1));
  return {select(has_direction, x * scale, FloatN(1)), select(has_direction, y * scale, FloatN(0))};
}

}  // namespace

Frame<FloatN> SceneTables::shading_frame(const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                                         const TexturePoint<FloatN>* point) const {
  Frame<FloatN> frame(surface.ns);
  if (anisotropic_.empty() || point == nullptr) return frame;
  const Vec3<FloatN> tangent = point->tangent - surface.ns * dot(surface.ns, point->tangent);
  const FloatN size = length(tangent);
  const MaskN turned = float_mask<FloatN>(gather(anisotropic_.data(), material(hits)) != IntN(0)) &
                       (size > length(point->tangent) * FloatN(1e-3F));
  frame.x = select(turned, tangent * (FloatN(1) / size), frame.x);
  frame.y = select(turned, cross(frame.z, frame.x), frame.y);
  if (has_turned_tangents_) [[unlikely]]
    turn_tangents(hits, *point, frame);
  return frame;
}

void SceneTables::turn_tangents(const Hits& hits, const TexturePoint<FloatN>& point, Frame<FloatN>& frame) const {
  for_each_detail(hits, [&](const SurfaceDetail& detail, const MaskN& here) {
    if (!detail.has_turned_tangent()) return;
    const UvPoint<FloatN>& on = point.by(detail.tangent_set);
    const Vec3<FloatN> along = on.tangent - frame.z * dot(frame.z, on.tangent);
    const FloatN size = length(along);
    const MaskN turned = here & (size > length(on.tangent) * FloatN(1e-3F));
    const Vec3<FloatN> u = along * (FloatN(1) / size), across = cross(frame.z, u);
    const Vec3<FloatN> v = select(dot(across, on.bitangent) < FloatN(0), -across, across);
    Vec2<FloatN> tangent{FloatN(1), FloatN(0)};
    if (detail.tangentmap) tangent = mapped_tangent(textures_->vector_at(*detail.tangentmap, point));
    FloatN turns(detail.tangentrotation.value);
    if (const auto& texture = detail.tangentrotation.texture) turns = turns * textures_->number_at(*texture, point);
    constexpr float most_turns = 1e6F;
    const auto [sine, cosine] = sin_cos_of_turns(min(max(turns, FloatN(-most_turns)), FloatN(most_turns)));
    frame.x = select(turned, u * (tangent.x * cosine - tangent.y * sine) + v * (tangent.x * sine + tangent.y * cosine),
                     frame.x);
    frame.y = select(turned, cross(frame.z, frame.x), frame.y);
  });
}

}  // namespace raytrace
