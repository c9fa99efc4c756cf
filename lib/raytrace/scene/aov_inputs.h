// What a packet of camera rays met, as AOVs want it.
#pragma once

#include "raytrace/scene/scene_tables.h"

namespace raytrace {

/// Lanes without a hit hold anything.
class AovInputs {
 public:
  /// rays: from the camera to what they hit. All must outlive it.
  AovInputs(const SceneTables& scene, const Ray<FloatN>& rays, const Hits& hits,
            const SurfaceInteraction<FloatN>& surface)
      : scene_(scene), rays_(rays), hits_(hits), surface_(surface) {}

  const MaskN& hit() const { return hits_.hit; }

  /// From the eye, along the camera's viewing direction.
  FloatN depth() const { return rays_.far * dot(rays_.direction, Vec3<FloatN>(scene_.viewing_direction())); }
  const Vec3<FloatN>& position() const { return surface_.p; }
  const Vec3<FloatN>& normal() const { return surface_.ns; }
  /// What the material reflects diffusely of light from all sides.
  Rgb<FloatN> albedo() const { return scene_.albedo(hits_); }
  /// The numbers of the object and its material, counted from 0, in the orders of object_names() and material_names().
  IntN object() const { return scene_.object(hits_); }
  IntN material() const { return scene_.material(hits_); }

  /// A number as an id, counted from 1, the bits of which stand in floats.
  static FloatN id(const IntN& number) { return same_bits<FloatN>(number + IntN(1)); }

 private:
  const SceneTables& scene_;
  const Ray<FloatN>& rays_;
  const Hits& hits_;
  const SurfaceInteraction<FloatN>& surface_;
};

}  // namespace raytrace
