// What an integrator answers for a packet of camera rays.
#pragma once

#include <optional>

#include "raytrace/math/color.h"
#include "raytrace/scene/environment.h"
#include "raytrace/scene/hits.h"
#include "raytrace/scene/surface_interaction.h"
#include "raytrace/textures/texture_point.h"

namespace raytrace {

struct RayResult {
  Rgb<FloatN> radiance;
  MaskN hit;  ///< false: the background was met
};

/// The radiance, of the environment where nothing else was met. The arguments are copies of the innermost loop's, which
/// stay in registers there.
[[gnu::noinline]] inline Rgb<FloatN> in_environment(const Environment& environment, const RayResult& result,
                                                    const Vec3<FloatN>& direction) {
  if (all(result.hit)) return result.radiance;
  return select(result.hit, result.radiance, environment.radiance(direction));
}

/// What the rays met first, for AOVs.
struct FirstHits {
  Hits hits;
  SurfaceInteraction<FloatN> surface;
  std::optional<TexturePoint<FloatN>> textures;  ///< none where no lane has any
};

}  // namespace raytrace
