// What a packet of camera rays met, as AOVs want it.
#pragma once

#include "raytrace/math/doubles.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

/// Lanes without a hit hold anything.
class AovInputs {
 public:
  /// camera: rays to what they hit. All must outlive it.
  /// textures: null where no lane has any.
  AovInputs(const SceneTables& scene, const CameraRays& camera, const Hits& hits,
            const SurfaceInteraction<FloatN>& surface, const TexturePoint<FloatN>* textures)
      : scene_(scene), camera_(camera), hits_(hits), surface_(surface), textures_(textures) {}

  const MaskN& hit() const { return hits_.hit; }

  /// From the eye, along the camera's viewing direction; of a camera that has no view plane, along the ray.
  FloatN depth() const {
    const Ray<FloatN>& rays = camera_.rays;
    const FloatN distance = camera_.skipped + rays.far;
    if (scene_.depth_is_distance()) return distance;
    return distance * dot(rays.direction, Vec3<FloatN>(scene_.viewing_direction()));
  }
  /// In the world.
  Vec3<FloatN> position() const {
    const Vec3d& origin = scene_.origin();
    if (origin.x == 0 && origin.y == 0 && origin.z == 0) return surface_.p;
    using D = Doubles<FloatN>;
    return to_float(Vec3<D>(surface_.p) + Vec3<D>(origin));
  }
  /// For shading; of the base under a coat.
  Vec3<FloatN> normal() const { return surface_.base_normal(); }
  /// What the material reflects diffusely of light from all sides.
  Rgb<FloatN> albedo() const { return scene_.albedo(hits_, textures_); }
  /// The numbers of the object and its material, counted from 0, in the orders of object_names() and material_names().
  IntN object() const { return scene_.part_or_object(hits_); }
  IntN material() const { return scene_.material(hits_); }

  /// A number as an id, counted from 1, the bits of which stand in floats.
  static FloatN id(const IntN& number) { return same_bits<FloatN>(number + IntN(1)); }

 private:
  const SceneTables& scene_;
  const CameraRays& camera_;
  const Hits& hits_;
  const SurfaceInteraction<FloatN>& surface_;
  const TexturePoint<FloatN>* textures_;
};

}  // namespace raytrace
