// Light that a surface scatters, apart by how: for passes (film/light_pass.h).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "raytrace/film/light_pass.h"
#include "raytrace/scene/scene_tables.h"
#include "raytrace/tracing/ray_result.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

/// Of a packet's samples, what each pass has.
using PassLight = std::array<Rgb<FloatN>, light_pass_count>;

inline PassLight no_pass_light() {
  PassLight light;
  light.fill(Rgb<FloatN>(Rgb<float>(0, 0, 0)));
  return light;
}

/// Of an integrator that knows no lights: as if all surfaces shone.
inline PassLight emitted_or_behind(const RayResult& result) {
  PassLight light = no_pass_light();
  const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
  light[static_cast<std::size_t>(LightPass::emission)] = select(result.hit, result.radiance, black);
  light[static_cast<std::size_t>(LightPass::background)] = select(result.hit, black, result.radiance);
  return light;
}

/// The share of each channel that the part has of the whole, in [0, 1].
inline Rgb<FloatN> share_of(const Rgb<FloatN>& part, const Rgb<FloatN>& whole) {
  const auto share = [](const FloatN& a, const FloatN& b) {
    return select(abs(b) > FloatN(0), min(max(a / b, FloatN(0)), FloatN(1)), FloatN(0));
  };
  return {share(part.red, whole.red), share(part.green, whole.green), share(part.blue, whole.blue)};
}

/// The share of gloss in what surfaces send along wo of light that BSDFs drew a direction for; 0 where it comes from
/// below the surface.
inline Rgb<FloatN> gloss_share(const SceneTables& tables, const PathVertex& vertex, const Refraction<FloatN>& media,
                               const BsdfSample<FloatN>& sample) {
  const Rgb<FloatN> white(Rgb<float>(1, 1, 1)), black(Rgb<float>(0, 0, 0));
  const MaskN above = (sample.wi.z > FloatN(0)) & !sample.enters;
  Rgb<FloatN> share = white;
  if (const MaskN rough = above & !sample.specular; any(rough)) {
    const Vec3<FloatN> wo = vertex.frame.to_local(vertex.surface.wo);
    const Rgb<FloatN> gloss =
        tables.gloss(vertex.hits, vertex.surface, vertex.frame, media, wo, sample.wi, Gloss::any, vertex.textures);
    share = select(rough, share_of(gloss, sample.f), share);
  }
  return select(above, share, black);
}

/// Adds the parts of light that was drawn for a vertex. arrived: what leaves of it along wo. bsdf: of its direction.
inline void add_drawn_light(const SceneTables& tables, const PathVertex& vertex, const Refraction<FloatN>& media,
                            const DrawnLight& drawn, const BsdfValue& bsdf, const Rgb<FloatN>& arrived,
                            LightParts& parts) {
  const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
  BsdfSample<FloatN> sample{drawn.local_wi, bsdf.f, bsdf.pdf};
  parts.gloss += select(drawn.lit, arrived * gloss_share(tables, vertex, media, sample), black);
  parts.transmitted += select(drawn.lit & drawn.through, arrived, black);
}

}  // namespace raytrace
