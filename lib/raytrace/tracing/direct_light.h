// The light that comes to a surface from the scene's lights straight away: what integrators share.
#pragma once

#include <array>
#include <optional>

#include "raytrace/accel/surface_uv.h"
#include "raytrace/accel/traced_scene.h"
#include "raytrace/tracing/fog.h"
#include "raytrace/tracing/identified_rays.h"
#include "raytrace/tracing/panes.h"
#include "raytrace/tracing/render_report.h"
#include "raytrace/tracing/stage_times.h"

namespace raytrace {

/// Lights are gathered in runs of this many before the materials get them, so that each material reads its parameters
/// once a run. Lights that reach no lane count, too, so that how a lane's sum is grouped does not depend on its
/// neighbours.
inline constexpr std::size_t lights_per_run = 16;

/// The surface's own texture coordinates, where its materials want them, and its relief. radius: as texture_point()'s.
template <class Radius>
RAYTRACE_INLINE std::optional<TexturePoint<FloatN>> add_textures(const SceneTables& tables, const Hits& hits,
                                                                 SurfaceInteraction<FloatN>& surface,
                                                                 const Radius& radius) {
  if (!tables.has_textures(hits)) [[likely]]
    return std::nullopt;
  const TexturePoint<FloatN> point = texture_point(tables, radius(), hits, surface);
  if (tables.has_relief()) tables.add_relief(hits, point, surface);
  return point;
}

/// As occluded_identified(), by all but panes. light: of what is not occluded, panes take their part.
[[gnu::noinline]] inline MaskN occluded_behind_panes(const TracedScene& scene, const Ray<FloatN>& rays,
                                                     const MaskN& active, const RayIds& ids, Coherence coherence,
                                                     const PanesAhead& panes, Rgb<FloatN>& light) {
  RayIdentity identity(scene.tables(), scene.accelerator(), rays, ids);
  std::uint32_t passed = 0;
  identity.meets = Meets::surfaces_but_panes;
  identity.passed_panes = &passed;
  const MaskN occluded = scene.accelerator().occluded(rays, active, coherence, nullptr, &identity);
  if (passed == 0) return occluded;
  alignas(64) std::array<std::int32_t, packet_lanes> has_passed;
  for (std::size_t i = 0; i < packet_lanes; ++i) has_passed[i] = static_cast<std::int32_t>(passed >> i & 1U);
  const MaskN behind = active & !occluded & float_mask<FloatN>(IntN::load_aligned(has_passed.data()) != IntN(0));
  if (any(behind)) light = select(behind, light * light_through_panes(scene, rays, behind, ids, panes), light);
  return occluded;
}

/// The random numbers of a point's shadow rays, each for its light.
struct ShadowNumbers {
  const UintN& pixel;
  const UintN& sample;
  std::uint32_t before;  ///< what of the sample's rays came before the first of them

  RayIds ids(std::size_t light) const { return {pixel, sample, number(light)}; }
  /// The place on the light.
  Sample2D place(std::size_t light) const { return get_2d(pixel, sample, shadow_dimension(number(light))); }

 private:
  std::uint32_t number(std::size_t light) const { return before + static_cast<std::uint32_t>(light); }
};

/// What lights behind a surface need to know of it, which sends their light on in some lanes.
struct LightsBehind {
  const MaskN& lanes;
  const MaskN& fibres;  ///< those of them that light comes to from all sides; ng says which is behind
  const MediumBoundary& boundary;
  const FloatN& distance;  ///< that paths came to it
};

/// Parts of the light that leaves surfaces along wo; the rest is diffuse.
struct LightParts {
  Rgb<FloatN> gloss{Rgb<float>(0, 0, 0)}, transmitted{Rgb<float>(0, 0, 0)};

  /// Of light that they are parts of, the rest; where that is no more than rounding, it goes to the larger of the two.
  Rgb<FloatN> take_diffuse(const Rgb<FloatN>& light) {
    const auto take = [](const FloatN& whole, FloatN& of_gloss, FloatN& of_transmitted) {
      const FloatN rest = whole - of_gloss - of_transmitted;
      const MaskN is_none = abs(rest) <= abs(whole) * FloatN(1e-5F), of_first = abs(of_gloss) >= abs(of_transmitted);
      of_gloss = select(is_none & of_first, of_gloss + rest, of_gloss);
      of_transmitted = select(is_none & !of_first, of_transmitted + rest, of_transmitted);
      return select(is_none, FloatN(0), rest);
    };
    return {take(light.red, gloss.red, transmitted.red), take(light.green, gloss.green, transmitted.green),
            take(light.blue, gloss.blue, transmitted.blue)};
  }
};

/// Adds what the surfaces send on of lights that reach them. refraction: around them.
[[gnu::noinline]] inline void add_parts(const SceneTables& tables, const Hits& hits,
                                        const SurfaceInteraction<FloatN>& surface,
                                        std::span<const IncidentLight> lights, const TexturePoint<FloatN>* textures,
                                        const Refraction<FloatN>& refraction, LightParts& parts) {
  const Frame<FloatN> frame = tables.shading_frame(hits, surface, textures);
  const Vec3<FloatN> wo = frame.to_local(surface.wo);
  for (const IncidentLight& light : lights) {
    const Rgb<FloatN> arriving = light.radiance * light.cosine;
    const Vec3<FloatN> wi = frame.to_local(light.wi);
    const MaskN lit = hits.hit & (light.cosine > FloatN(0)), above = lit & (wi.z > FloatN(0)), below = lit & !above;
    if (any(above))
      parts.gloss +=
          select(above, tables.gloss(hits, surface, frame, refraction, wo, wi, Gloss::any, textures) * arriving,
                 Rgb<FloatN>(Rgb<float>(0, 0, 0)));
    if (none(below)) continue;
    IncidentLight through = light;
    through.cosine = select(below, light.cosine, FloatN(0));
    parts.transmitted += tables.shade(hits, surface, Rgb<float>(0, 0, 0), {&through, 1}, textures, refraction);
  }
}

/// What of the group's lights' radiance leaves the surface along wo, in the lanes that were hit; of its ambient light,
/// too. clock: if not null, its stages of this end here. media: if not null, what the light comes through. panes:
/// likewise, where it comes through some. draws: whether lights may be drawn, where there are many. behind: null where
/// no light of the scene comes through surfaces, scattered. parts: if not null, gets those of the result added.
RAYTRACE_INLINE Rgb<FloatN> direct_light(const TracedScene& scene, const SceneTables::LightGroup& group,
                                         const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                                         const TexturePoint<FloatN>* textures, Coherence coherence,
                                         const MaskN& counted, RayCounts& counts, const ShadowNumbers& numbers,
                                         StageClock* clock = nullptr, const PointMedia* media = nullptr,
                                         const PanesAhead* panes = nullptr, bool draws = false,
                                         const LightsBehind* behind = nullptr, LightParts* parts = nullptr) {
  const SceneTables& tables = scene.tables();
  std::array<IncidentLight, lights_per_run> incident;
  std::size_t count = 0;
  Rgb<FloatN> radiance{Rgb<float>(0, 0, 0)};
  Rgb<float> ambient = group.ambient_radiance;
  Refraction<FloatN> refraction;  // what reflects alone is as if all was in air
  Vec3<FloatN> side = surface.ns;
  if (behind != nullptr) [[unlikely]] {
    const Refraction<FloatN>& there = behind->boundary.media;
    refraction.outside = select(behind->lanes, there.outside, refraction.outside);
    refraction.factor = select(behind->lanes, there.factor, refraction.factor);
    refraction.disperses = there.disperses;
    side = select(behind->lanes, Vec3<FloatN>(Vec3f(0, 0, 0)), side);
  }
  const auto end = [&](Stage stage) {
    if (clock != nullptr) clock->end(stage);
  };
  const auto shade_run = [&] {
    end(Stage::lights);
    const std::span<const IncidentLight> run(incident.data(), count);
    radiance += behind == nullptr ? tables.shade(hits, surface, ambient, run, textures)
                                  : tables.shade(hits, surface, ambient, run, textures, refraction);
    if (parts != nullptr) [[unlikely]]
      add_parts(tables, hits, surface, run, textures, refraction, *parts);
    ambient = Rgb<float>(0, 0, 0);
    count = 0;
    end(Stage::shade);
  };
  Ray<FloatN> shadow_rays;
  shadow_rays.origin = offset_ray_origin(surface);
  shadow_rays.near = FloatN(0);
  const Sample2D middle{FloatN(0), FloatN(0)};
  const bool has_drawn = group.drawn && draws;
  const std::size_t last_light = has_drawn ? group.first_drawn + ManyLights::draws : group.last_light;
  const FloatN u_of_drawn = has_drawn ? numbers.place(group.first_drawn).x : FloatN(0);
  for (std::size_t number = group.first_light; number < last_light; ++number) {
    // The first run has the ambient light, whatever the others reach.
    const std::size_t before = number - group.first_light;
    if (before > 0 && before % lights_per_run == 0 && (count > 0 || before == lights_per_run)) shade_run();
    const LightSource& light = *tables.lights()[number];
    bool shadows = light.shadows();
    MaskN has_shadow(true);                 // of those that are drawn, each lane's
    IncidentLight& here = incident[count];  // written in its array at once: it is large
    if (behind != nullptr) [[unlikely]]
      shadow_rays.origin = offset_ray_origin(surface);
    const bool is_drawn = has_drawn && number >= group.first_drawn;
    if (is_drawn) [[unlikely]] {
      const FloatN u = u_of_drawn + FloatN(static_cast<float>(number - group.first_drawn));
      const FloatN share(1 / static_cast<float>(ManyLights::draws));
      has_shadow = group.drawn->sample(shadow_rays, side, u * share, here.radiance);
      here.radiance = here.radiance * share;
      shadows = true;
    } else if (tables.has_sampled_lights() && light.takes_samples()) [[unlikely]]
      light.sample(shadow_rays, numbers.place(number), here.radiance);
    else
      light.sample(shadow_rays, middle, here.radiance);
    // Of any length: the shadow rays need not wait for a square root and a quotient.
    MaskN lit = hits.hit & (dot(surface.ns, shadow_rays.direction) > FloatN(0));
    MaskN through(false);
    if (behind != nullptr) [[unlikely]] {
      const Vec3<FloatN>& way = shadow_rays.direction;
      through =
          behind->lanes & (dot(surface.ng, way) < FloatN(0)) & (behind->fibres | (dot(surface.ns, way) < FloatN(0)));
      const Vec3<FloatN> origin = offset_ray_origin(surface, through);
      const MaskN is_near = through & (shadow_rays.far < infinity<FloatN>());
      shadow_rays.direction = select(is_near, way + (shadow_rays.origin - origin), way);
      shadow_rays.origin = origin;
      lit = lit | through | behind->fibres;
    }
    // Where rays look for boundaries as well, those to spotlights from outside of their cones are too many. So are they
    // where nothing was drawn.
    if (media != nullptr || is_drawn) [[unlikely]]
      lit = lit & (abs(here.radiance.red) + abs(here.radiance.green) + abs(here.radiance.blue) > FloatN(0));
    if (const MaskN may_hide = lit & has_shadow; shadows && any(may_hide)) {
      end(Stage::lights);
      counts.shadow += count_lanes(may_hide & counted);
      const MaskN occluded =
          panes != nullptr ? occluded_behind_panes(scene, shadow_rays, may_hide, numbers.ids(number), coherence, *panes,
                                                   here.radiance)
          : tables.identifies_rays() ? occluded_identified(scene, shadow_rays, may_hide, numbers.ids(number), coherence)
          : is_drawn
              ? scene.accelerator().occluded(shadow_rays, may_hide, Coherence::incoherent)
              : scene.accelerator().occluded(shadow_rays, may_hide, Coherence::coherent, scene.light_buffer(number));
      lit = lit & !occluded;
      end(Stage::trace);
    }
    if (none(lit)) continue;
    if (media != nullptr) [[unlikely]] {
      if (any(through)) {
        const MediaOfLight there(scene, behind->boundary, media->stack, through & lit, surface.front, shadow_rays,
                                 behind->distance, numbers.ids(number));
        here.radiance = here.radiance * light_through(scene, shadow_rays, lit, numbers.ids(number), there.media());
      } else {
        here.radiance = here.radiance * light_through(scene, shadow_rays, lit, numbers.ids(number), *media);
      }
    }
    here.wi = normalize(shadow_rays.direction);
    here.cosine = select(lit, max(dot(surface.ns, here.wi), FloatN(0)), FloatN(0));
    if (surface.has_relief) [[unlikely]]
      here.cosine = here.cosine * relief_shadow(surface, here.wi);
    if (behind != nullptr) [[unlikely]]
      here.cosine = select(lit & (through | behind->fibres), abs(dot(surface.ns, here.wi)), here.cosine);
    ++count;
  }
  if (count > 0 || last_light - group.first_light <= lights_per_run) shade_run();
  return radiance;
}

}  // namespace raytrace
