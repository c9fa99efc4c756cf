// What an integrator answers for a packet of camera rays.
#pragma once

#include <optional>

#include "raytrace/math/color.h"
#include "raytrace/scene/hits.h"
#include "raytrace/scene/surface_interaction.h"
#include "raytrace/textures/texture_point.h"

namespace raytrace {

struct RayResult {
  Rgb<FloatN> radiance;
  MaskN hit;  ///< false: the background was met
};

/// What the rays met first, for AOVs.
struct FirstHits {
  Hits hits;
  SurfaceInteraction<FloatN> surface;
  std::optional<TexturePoint<FloatN>> textures;  ///< none where no lane has any
};

}  // namespace raytrace
