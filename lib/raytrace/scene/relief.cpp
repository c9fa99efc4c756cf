// Normal maps and bumps: what they make of shading normals, and of those of coats.
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

namespace {

/// Over how much of what else a sample covers relief is looked up: little, but no less than slopes need, which are
/// differences of floats.
FloatN relief_part(const TexturePoint<FloatN>& point) {
  const FloatN usual(0.125F), digits(0x1p-15F), one(1);
  const auto needed = [&](const FloatN& size, const FloatN& step) {
    return select(step > FloatN(0), size * digits / step, one);
  };
  const SpacePoint<FloatN>& world = point.world;
  const FloatN in_space = needed(largest_component(world.p), largest_component(world.p_across));
  const Vec2<FloatN>&uv = point.uv, &across = point.uv_across;
  const FloatN on_surface = needed(max(abs(uv.x), abs(uv.y)), max(abs(across.x), abs(across.y)));
  return min(max(max(in_space, on_surface), usual), one);
}

/// Where relief is looked up. Normals that are averaged over all that a sample covers are those of a smoother surface,
/// so that a material would be another from afar; what one sample does not show of them, many do.
TexturePoint<FloatN> relief_point(const TexturePoint<FloatN>& point) {
  const FloatN part = relief_part(point);
  TexturePoint<FloatN> fine = point;
  for (UvPoint<FloatN>* const on : {&fine.by(UvSet::first), &fine.by(UvSet::second)}) {
    on->uv_across = {on->uv_across.x * part, on->uv_across.y * part};
    on->uv_along = {on->uv_along.x * part, on->uv_along.y * part};
  }
  for (SpacePoint<FloatN>* const in : {&fine.world, &fine.object}) {
    in->p_across = in->p_across * part;
    in->p_along = in->p_along * part;
  }
  return fine;
}

/// A map's normal, in the frame of the texture coordinates about `normal`. Where they have none, at a pole, it stays.
/// side: 1, or -1 where the surface shows its back, whose hills are the front's hollows.
Vec3<FloatN> mapped_normal(const Rgb<FloatN>& map, const FloatN& side, float strength, const UvPoint<FloatN>& point,
                           const Vec3<FloatN>& normal) {
  const auto component = [](const FloatN& number) { return number * FloatN(2) - FloatN(1); };
  const Vec3<FloatN> u = point.tangent - normal * dot(normal, point.tangent);
  const FloatN size = length(u);
  const MaskN has_tangent = size > FloatN(0);
  const Vec3<FloatN> tangent = u * (FloatN(1) / select(has_tangent, size, FloatN(1)));
  const Vec3<FloatN> across = cross(normal, tangent);
  const Vec3<FloatN> bitangent = select(dot(across, point.bitangent) < FloatN(0), -across, across);
  const FloatN x = component(map.red) * FloatN(strength) * side, y = component(map.green) * FloatN(strength) * side;
  // No normal points into its surface, as those of damaged maps may.
  const FloatN z = max(component(map.blue), FloatN(0.01F));
  return select(has_tangent, normalize(tangent * x + bitangent * y + normal * z), normal);
}

/// The normal of the surface that is higher by height(point), which looks up by that set of texture coordinates: by
/// its slopes towards what half a pixel covers.
template <class Height>
Vec3<FloatN> bumped_normal(const Height& height, const FloatN& side, UvSet set, const TexturePoint<FloatN>& point,
                           const Vec3<FloatN>& normal) {
  const FloatN here = height(point);
  const UvPoint<FloatN>& on = point.by(set);
  TexturePoint<FloatN> there = point;
  const auto slope = [&](Vec3<FloatN> SpacePoint<FloatN>::* direction, const Vec2<FloatN>& uv_way) {
    const Vec3<FloatN>& way = point.world.*direction;
    there.world.p = point.world.p + way;
    there.object.p = point.object.p + point.object.*direction;
    there.by(set).uv = {on.uv.x + uv_way.x, on.uv.y + uv_way.y};
    const FloatN size = length(way);
    const MaskN is_wide = size > FloatN(0);
    const FloatN inverse = FloatN(1) / select(is_wide, size, FloatN(1));
    // The square of a steeper slope would overflow.
    const FloatN rise = min(max((height(there) - here) * inverse, FloatN(-1e6F)), FloatN(1e6F));
    return way * (select(is_wide, rise, FloatN(0)) * inverse);
  };
  const Vec3<FloatN> slopes =
      slope(&SpacePoint<FloatN>::p_across, on.uv_across) + slope(&SpacePoint<FloatN>::p_along, on.uv_along);
  return normalize(normal - slopes * side);
}

}  // namespace

void SceneTables::add_relief(const Hits& hits, const TexturePoint<FloatN>& at,
                             SurfaceInteraction<FloatN>& surface) const {
  const TexturePoint<FloatN> point = relief_point(at);
  const FloatN side = select(surface.front, FloatN(1), FloatN(-1));
  const Vec3<FloatN> true_normal = surface.true_normal();
  const auto mapped = [&](const TexturedNumber& map, const Vec3<FloatN>& normal) {
    return mapped_normal(textures_->vector_at(*map.texture, point), side, map.value,
                         point.by(textures_->uvset(*map.texture)), normal);
  };
  // wo stays above the surface, as BSDFs expect it.
  const auto below_wo = [&](const Vec3<FloatN>& normal) {
    constexpr float least_cosine = 1e-3F;
    const FloatN behind = max(FloatN(least_cosine) - dot(normal, surface.wo), FloatN(0));
    return normalize(normal + surface.wo * behind);
  };
  // So does what a mirror would show there, which would be the dark inside else.
  const auto reflecting = [&](const Vec3<FloatN>& normal) {
    const FloatN least = min(max(dot(true_normal, surface.wo), FloatN(0)) * FloatN(0.9F), FloatN(0.01F));
    const Vec3<FloatN> mirrored = normal * (dot(normal, surface.wo) * FloatN(2)) - surface.wo;
    const FloatN below = max(least - dot(mirrored, true_normal), FloatN(0));
    const Vec3<FloatN> bent = normalize(normalize(mirrored + true_normal * below) + surface.wo);
    return select(below > FloatN(0), bent, normal);
  };
  surface.ns_without_relief = surface.ns;
  for_each_detail(hits, [&](const SurfaceDetail& detail, const MaskN& here) {
    if (!detail.has_relief() && !detail.has_layers()) return;
    Vec3<FloatN> normal = surface.ns;
    if (detail.normalmap.texture) normal = mapped(detail.normalmap, normal);
    if (const auto& bump = detail.bump; bump.texture)
      normal = bumped_normal(
          [&](const TexturePoint<FloatN>& p) { return textures_->number_at(*bump.texture, p) * FloatN(bump.value); },
          side, textures_->uvset(*bump.texture), point, normal);
    // What refracts has the same normal for light from all sides: paths from lights meet that of paths to them.
    const bool bends = !detail.is_even && !detail.refracts;
    Vec3<FloatN> diffuse = normal;
    if (detail.has_relief()) {
      diffuse = below_wo(normal);
      normal = bends ? reflecting(diffuse) : diffuse;
    }
    const auto set_layers = [&](const MaskN& lanes, const Vec3<FloatN>& coat) {
      if (!surface.has_layers) surface.layers = {MaskN(false), diffuse, normal, coat};
      surface.layers = {surface.layers.lanes | lanes, select(lanes, diffuse, surface.layers.diffuse),
                        select(lanes, normal, surface.layers.base), select(lanes, coat, surface.layers.coat)};
      surface.has_layers = true;
    };
    if (detail.has_layers()) [[unlikely]]
      return set_layers(here, detail.coatnormalmap.texture
                                  ? reflecting(below_wo(mapped(detail.coatnormalmap, surface.ns)))
                                  : surface.ns);
    surface.ns = select(here, normal, surface.ns);
    const MaskN ends_softly = here & MaskN(detail.is_even);
    surface.relief = surface.has_relief ? surface.relief | ends_softly : ends_softly;
    surface.has_relief = true;
  });
}

}  // namespace raytrace
