// What surfaces do with light: SceneTables' answers by the materials of what was hit.
#include <algorithm>
#include <optional>

#include "raytrace/bsdfs/lambertian.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/lanes.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

namespace {

Scattering select(const MaskN& mask, const Scattering& a, const Scattering& b) {
  return {select(mask, a.sample, b.sample),
          {select(mask, a.towards.f, b.towards.f), select(mask, a.towards.pdf, b.towards.pdf)}};
}

Subsurface<FloatN> select(const MaskN& mask, const Subsurface<FloatN>& a, const Subsurface<FloatN>& b) {
  return {select(mask, a.albedo, b.albedo), select(mask, a.free_path, b.free_path),
          select(mask, a.anisotropy, b.anisotropy), (a.is_sheet & mask) | (b.is_sheet & !mask)};
}

/// Of light that comes out from below a surface.
Lambertian<FloatN> emerging() { return {Rgb<FloatN>(Rgb<float>(1, 1, 1))}; }

Rgb<FloatN> shade_emerging(std::span<const IncidentLight> lights) {
  Rgb<FloatN> result(Rgb<float>(0, 0, 0));
  for (const IncidentLight& light : lights) result += light.radiance * light.cosine;
  return result * emerging().f();
}

Scattering scatter_emerging(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, const FloatN& u1, const FloatN& u2) {
  const Vec3<FloatN> normal = local_normal<FloatN>();
  const Lambertian<FloatN> even = emerging();
  const Vec3<FloatN> drawn = even.sample(wo, normal, u1, u2);
  return {{drawn, even.f(), even.pdf(wo, drawn, normal)}, {even.f(), even.pdf(wo, wi, normal)}};
}

}  // namespace

template <class Answer>
auto SceneTables::by_material(const Hits& hits, const Answer& answer) const {
  if (const std::optional<std::int32_t> only = geometry_->only_material(hits)) {
    const std::int32_t number = *only;
    const auto type = std::upper_bound(first_material_.begin(), first_material_.end() - 1, number) - 1;
    return answer(*materials_[static_cast<std::size_t>(type - first_material_.begin())], LaneIndices(number - *type));
  }
  const IntN number = material(hits);
  decltype(answer(*materials_[0], LaneIndices(0))) result{};
  for (std::size_t type = 0; type < materials_.size(); ++type) {
    const IntN first(first_material_[type]), end(first_material_[type + 1]);
    const MaskN here = float_mask<FloatN>(number >= first) & float_mask<FloatN>(number < end);
    if (none(here)) continue;
    const IntN index = number - first;
    // The other lanes follow the first of these, so that they read a material that exists.
    const LaneIndices indices = select_lanes(here, index, IntN(index.get(first_lane(here))));
    result = select(here, answer(*materials_[type], indices), result);
  }
  return result;
}

Rgb<FloatN> SceneTables::albedo(const Hits& hits, const TexturePoint<FloatN>* point) const {
  return by_material(
      hits, [&](const MaterialTable& table, const LaneIndices& materials) { return table.albedo(materials, point); });
}

bool SceneTables::has_textures(const Hits& hits) const {
  if (textured_.empty()) return false;
  if (const auto only = geometry_->only_material(hits)) return textured_[static_cast<std::size_t>(*only)] != 0;
  return any(hits.hit & float_mask<FloatN>(gather(textured_.data(), material(hits)) != IntN(0)));
}

Rgb<FloatN> SceneTables::emitted(const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                                 const TexturePoint<FloatN>* point) const {
  const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
  if (const auto only = geometry_->only_material(hits); only && shining_sides_[static_cast<std::size_t>(*only)] == 0)
    return black;
  const MaskN shining = hits.hit & shines(material(hits), surface.front);
  if (none(shining)) return black;
  const Rgb<FloatN> radiance = by_material(
      hits, [&](const MaterialTable& table, const LaneIndices& materials) { return table.emitted(materials, point); });
  return select(shining, radiance, black);
}

Scattering SceneTables::scatter(const Hits& hits, const SurfaceInteraction<FloatN>& surface, const Frame<FloatN>& frame,
                                const Refraction<FloatN>& media, const Vec3<FloatN>& wo, const MaskN& lit,
                                const Vec3<FloatN>& wi, const FloatN& u, const FloatN& u1, const FloatN& u2,
                                const TexturePoint<FloatN>* point) const {
  if (surface.has_emerging) [[unlikely]] {
    const Scattering even = scatter_emerging(wo, wi, u1, u2);
    if (none(hits.hit & !surface.emerges)) return even;
    SurfaceInteraction<FloatN> others = surface;
    others.has_emerging = false;
    return select(surface.emerges, even, scatter(hits, others, frame, media, wo, lit, wi, u, u1, u2, point));
  }
  const auto with_layers = [&](const LayerNormals<FloatN>* layers) {
    return by_material(hits, [&](const MaterialTable& table, const LaneIndices& materials) {
      return table.scatter(materials, surface.front, media, wo, lit, wi, u, u1, u2, layers, point);
    });
  };
  if (!surface.has_layers) [[likely]]
    return with_layers(nullptr);
  const LayerNormals<FloatN> layers = surface.layers.to_local(frame);
  return with_layers(&layers);
}

Rgb<FloatN> SceneTables::gloss(const Hits& hits, const SurfaceInteraction<FloatN>& surface, const Frame<FloatN>& frame,
                               const Refraction<FloatN>& media, const Vec3<FloatN>& wo, const Vec3<FloatN>& wi,
                               Gloss which, const TexturePoint<FloatN>* point) const {
  std::optional<LayerNormals<FloatN>> layers;
  if (surface.has_layers) layers = surface.layers.to_local(frame);
  const Rgb<FloatN> gloss = by_material(hits, [&](const MaterialTable& table, const LaneIndices& materials) {
    return table.gloss(materials, surface.front, media, wo, wi, which, layers ? &*layers : nullptr, point);
  });
  return surface.has_emerging ? select(surface.emerges, Rgb<FloatN>(Rgb<float>(0, 0, 0)), gloss) : gloss;
}

Subsurface<FloatN> SceneTables::subsurface(const Hits& hits, const TexturePoint<FloatN>* point) const {
  return by_material(hits, [&](const MaterialTable& table, const LaneIndices& materials) {
    return table.subsurface(materials, point);
  });
}

Rgb<FloatN> SceneTables::transmittance(const Hits& hits, const FloatN& distance,
                                       const TexturePoint<FloatN>* point) const {
  return by_material(hits, [&](const MaterialTable& table, const LaneIndices& materials) {
    return table.transmittance(materials, distance, point);
  });
}

Rgb<FloatN> SceneTables::straight(const Hits& hits, const Refraction<FloatN>& media, const Vec3<FloatN>& wo,
                                  const TexturePoint<FloatN>* point) const {
  return by_material(hits, [&](const MaterialTable& table, const LaneIndices& materials) {
    return table.straight(materials, media, wo, point);
  });
}

Rgb<FloatN> SceneTables::shade(const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                               const Rgb<float>& ambient_radiance, std::span<const IncidentLight> lights,
                               const TexturePoint<FloatN>* point, const Refraction<FloatN>& media) const {
  if (surface.has_emerging) [[unlikely]] {
    const Rgb<FloatN> even = shade_emerging(lights);
    if (none(hits.hit & !surface.emerges)) return even;
    SurfaceInteraction<FloatN> others = surface;
    others.has_emerging = false;
    return select(surface.emerges, even, shade(hits, others, ambient_radiance, lights, point, media));
  }
  const auto in_frame = [&](const Frame<FloatN>* frame) {
    return by_material(hits, [&](const MaterialTable& table, const LaneIndices& materials) {
      return table.shade(materials, surface.front, media, surface.wo, surface.ns, frame, ambient_radiance, lights,
                         surface.has_layers ? &surface.layers : nullptr, point);
    });
  };
  if (anisotropic_.empty()) [[likely]]
    return in_frame(nullptr);
  const Frame<FloatN> frame = shading_frame(hits, surface, point);
  return in_frame(&frame);
}

}  // namespace raytrace
