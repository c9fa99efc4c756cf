// Normal maps and bumps: what they make of shading normals.
#include <bit>

#include "raytrace/scene/scene_tables.h"

namespace raytrace {

namespace {

/// The unit vector of one that is not 0.
Vec3<FloatN> unit(const Vec3<FloatN>& v) { return v * (FloatN(1) / sqrt(max(dot(v, v), FloatN(1e-30F)))); }

/// A map's normal, in the frame of the texture coordinates about `normal`. Where they have none, at a pole, it stays.
Vec3<FloatN> mapped_normal(const Rgb<FloatN>& map, float strength, const TexturePoint<FloatN>& point,
                           const Vec3<FloatN>& normal) {
  const auto component = [](const FloatN& number) { return number * FloatN(2) - FloatN(1); };
  const Vec3<FloatN> u = point.dpdu - normal * dot(normal, point.dpdu);
  const FloatN squared = dot(u, u);
  const Vec3<FloatN> tangent = u * (FloatN(1) / sqrt(max(squared, FloatN(1e-30F))));
  const Vec3<FloatN> across = cross(normal, tangent);
  const Vec3<FloatN> bitangent = select(dot(across, point.dpdv) < FloatN(0), -across, across);
  const FloatN x = component(map.red) * FloatN(strength), y = component(map.green) * FloatN(strength);
  // A map of heights below the surface there would be.
  const FloatN z = max(component(map.blue), FloatN(0.01F));
  return select(squared > FloatN(1e-30F), unit(tangent * x + bitangent * y + normal * z), normal);
}

/// The normal of the surface that is higher by height(point): by its slopes towards what half a pixel covers.
template <class Height>
Vec3<FloatN> bumped_normal(const Height& height, const TexturePoint<FloatN>& point, const Vec3<FloatN>& normal) {
  const FloatN here = height(point);
  const auto slope = [&](const Vec3<FloatN>& way, const Vec2<FloatN>& uv_way) {
    TexturePoint<FloatN> there = point;
    there.p = point.p + way;
    there.uv = {point.uv.x + uv_way.x, point.uv.y + uv_way.y};
    const FloatN squared = dot(way, way);
    const FloatN rise = select(squared > FloatN(0), (height(there) - here) / max(squared, FloatN(1e-30F)), FloatN(0));
    return way * rise;
  };
  return unit(normal - slope(point.p_across, point.uv_across) - slope(point.p_along, point.uv_along));
}

}  // namespace

void SceneTables::add_relief(const Hits& hits, const TexturePoint<FloatN>& point,
                             SurfaceInteraction<FloatN>& surface) const {
  const IntN materials = material(hits);
  for (MaskN left = hits.hit; any(left);) {
    const std::int32_t number = materials.get(static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(left))));
    const MaskN here = left & float_mask<FloatN>(materials == IntN(number));
    left = left & !here;
    const SurfaceDetail& detail = details_[static_cast<std::size_t>(number)];
    if (!detail.has_relief()) continue;
    Vec3<FloatN> normal = surface.ns;
    if (const auto& map = detail.normalmap; map.texture)
      normal = mapped_normal(textures_->vector_at(*map.texture, point), map.value, point, normal);
    if (const auto& bump = detail.bump; bump.texture)
      normal = bumped_normal(
          [&](const TexturePoint<FloatN>& at) { return textures_->number_at(*bump.texture, at) * FloatN(bump.value); },
          point, normal);
    // The viewer sees no surface from behind.
    constexpr float least_cosine = 1e-3F;
    const FloatN behind = max(FloatN(least_cosine) - dot(normal, surface.wo), FloatN(0));
    normal = unit(normal + surface.wo * behind);
    surface.ns = select(here, normal, surface.ns);
    surface.has_relief = true;
  }
}

}  // namespace raytrace
