// Direct light by ray casting (Suffern, chapters 14 to 16): the nearest hit, lit by the scene's lights, with a shadow
// ray to each that casts shadows.
#pragma once

#include "raytrace/scene/traced_scene.h"

namespace raytrace {

/// What a packet of camera rays sees.
struct RayResult {
  Rgb<FloatN> radiance;
  MaskN hit;  ///< false: the background was seen
};

/// What the rays met, for AOVs.
struct HitSurface {
  Hits hits;
  SurfacePoint<FloatN> point;  ///< its normal on the side that is seen
};

class Raycast {
 public:
  static constexpr std::string_view name = "raycast";

  /// The radiance that arrives along the rays, whose directions have unit length, in the lanes of `active`, and ends
  /// the rays where it comes from; `background` arrives along those that meet nothing. Adds the shadow rays in the
  /// lanes of `counted` to `counts`, and sets `met` to what was met if it is not null.
  static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, Ray<FloatN>& rays,
                            const MaskN& active, const MaskN& counted, RayCounts& counts, HitSurface* met);
};

}  // namespace raytrace
