// What a packet of camera rays sees, as AOVs ask for it.
#pragma once

#include <bit>

#include "raytrace/scene/traced_scene.h"

namespace raytrace {

/// Lanes without a hit hold anything.
class AovInputs {
 public:
  /// rays: from the eye to what they hit. point: of that, its normal on the side that is seen. All must outlive it.
  AovInputs(const TracedScene& scene, const Ray<FloatN>& rays, const Hits& hits, const SurfacePoint<FloatN>& point)
      : scene_(scene), rays_(rays), hits_(hits), point_(point) {}

  const MaskN& hit() const { return hits_.hit; }

  /// From the eye, along the camera's viewing direction.
  FloatN depth() const { return rays_.far * dot(rays_.direction, Vec3<FloatN>(scene_.viewing_direction())); }
  const Vec3<FloatN>& position() const { return point_.position; }
  const Vec3<FloatN>& normal() const { return point_.normal; }
  /// What the material reflects diffusely of light from all sides.
  Rgb<FloatN> albedo() const { return scene_.albedo(hits_); }
  /// The object's and its material's places, counted from 0, in the orders of object_names() and material_names().
  IntN object() const { return scene_.object(hits_); }
  IntN material() const { return scene_.material(hits_); }

  /// A place as an id, counted from 1, the bits of which stand in floats.
  static FloatN id(const IntN& place) { return same_bits<FloatN>(place + IntN(1)); }

 private:
  const TracedScene& scene_;
  const Ray<FloatN>& rays_;
  const Hits& hits_;
  const SurfacePoint<FloatN>& point_;
};

}  // namespace raytrace
