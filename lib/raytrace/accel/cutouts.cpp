#include "raytrace/accel/cutouts.h"

#include <array>

#include "raytrace/accel/accelerator.h"
#include "raytrace/accel/surface_uv.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/sampler.h"

namespace raytrace {

RayIdentity::RayIdentity(const SceneTables& of_scene, const Accelerator& its_accelerator, const Ray<FloatN>& its_rays,
                         const RayIds& ids, const CameraRays* its_camera)
    : scene(of_scene),
      accelerator(its_accelerator),
      rays(its_rays),
      pixels(of_scene.has_cutouts() ? ids.pixel_keys() : UintN(0u)),
      samples(ids.sample),
      times(of_scene.has_motion() ? ids.times() : FloatN(0)),
      camera(its_camera) {
  if (camera != nullptr) set_seeing(MaskN(true));
}

void RayIdentity::set_seeing(const MaskN& lanes) {
  if (scene.geometry().has_invisible()) seeing = bits_of<FloatN>(lanes);
}

std::uint32_t unseen_by(const RayIdentity& query, unsigned first, const CutoutSurface& surface) {
  const bool is_seen = !query.scene.geometry().is_invisible(surface.instance, surface.geometry, surface.primitive);
  return is_seen ? 0 : query.seeing >> first;
}

std::uint32_t crossed_by(const RayIdentity& query, unsigned first, const CutoutSurface& surface) {
  const bool is_mesh = surface.geometry >= Shapes::size;
  MaskN same(false);
  for (const Hits& crossed : query.crossed) {
    MaskN here = crossed.hit & float_mask<FloatN>(crossed.instance == UintN(surface.instance)) &
                 float_mask<FloatN>(crossed.geometry == UintN(surface.geometry));
    if (!is_mesh)
      here = here & float_mask<FloatN>(crossed.primitive == IntN(static_cast<std::int32_t>(surface.primitive)));
    same = same | here;
  }
  return bits_of<FloatN>(same) >> first;
}

std::optional<std::int32_t> cutout_material(const RayIdentity& query, const CutoutSurface& surface) {
  const std::int32_t material =
      query.scene.geometry().material_of(surface.instance, surface.geometry, surface.primitive);
  const bool is_cutout = query.scene.is_cutout(material);
  bool passes = is_cutout;
  if (query.meets == Meets::boundaries_of_fogs) passes = !query.scene.is_fog(material);
  if (query.meets == Meets::surfaces_but_panes) passes = is_cutout || query.scene.is_pane(material);
  if (query.meets == Meets::panes) passes = is_cutout || !query.scene.is_pane(material);
  return passes ? std::optional(material) : std::nullopt;
}

std::uint32_t passing_rays(const RayIdentity& query, unsigned first, std::uint32_t hit, const CutoutSurface& surface,
                           std::int32_t material, std::span<const float> t, std::span<const float> u,
                           std::span<const float> v) {
  if (query.meets == Meets::boundaries_of_fogs || query.scene.is_fog(material)) return hit;
  // All of a pane, where it is not met, and all else, where panes alone are.
  if (query.meets == Meets::panes && !query.scene.is_pane(material)) return hit;
  if (query.meets == Meets::surfaces_but_panes && query.scene.is_pane(material)) {
    if (query.passed_panes != nullptr) *query.passed_panes |= hit << first;
    return hit;
  }
  alignas(64) std::array<float, packet_lanes> far{}, hit_u{}, hit_v{};
  alignas(64) std::array<std::int32_t, packet_lanes> is_hit{};
  for (std::size_t i = 0; i < t.size(); ++i) {
    if ((hit >> i & 1) == 0) continue;
    far[first + i] = t[i];
    hit_u[first + i] = u[i];
    hit_v[first + i] = v[i];
    is_hit[first + i] = -1;
  }
  Hits hits;
  hits.hit = float_mask<FloatN>(IntN::load_aligned(is_hit.data()) != IntN(0));
  hits.instance = UintN(surface.instance);
  hits.geometry = UintN(surface.geometry);
  hits.primitive = IntN(static_cast<std::int32_t>(surface.primitive));
  hits.u = FloatN::load_aligned(hit_u.data());
  hits.v = FloatN::load_aligned(hit_v.data());
  hits.time = query.times;
  hits.find_first();
  const SceneTables& scene = query.scene;
  const FloatN opacity = scene.opacity(material, [&] {
    if (const auto set = scene.opacity_uvset(material); set && query.camera == nullptr)
      if (const auto point = texture_point_of_coordinates(scene, hits, *set)) return *point;
    Ray<FloatN> rays = query.rays;
    rays.far = FloatN::load_aligned(far.data());
    FloatN width(0);
    if (query.camera != nullptr) width = scene.ray_cone().half_width(query.camera->skipped + rays.far);
    return texture_point(scene, width, hits, query.accelerator.surface(rays, hits));
  });
  const UintN seed = hash(query.pixels, UintN(surface.instance), UintN(surface.geometry),
                          UintN(mix_bits(surface.primitive) + surface.crossing));
  const FloatN number = to_unit(scrambled_number(seed, query.samples));
  // What is not a number meets nothing.
  return bits_of<FloatN>(hits.hit & !(number < opacity)) >> first;
}

}  // namespace raytrace
