// Rays of the scene's camera, whatever its type.
#pragma once

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

struct CaughtShadows;

/// Rays of a camera, and how much of the way from the eye to where they begin they leave out.
struct CameraRays {
  Ray<FloatN> rays;
  FloatN skipped{0};  ///< rays.near may be as far before their origins, of a camera that is far away
  // Of integrators that take samples, and in scenes with opacities: the pixel's hash, and the sample's index.
  UintN pixel{0u}, sample{0u};
  /// Receives the shadows on shadow catchers (tracing/shadow_catcher.h); null: these are surfaces like any other.
  CaughtShadows* caught = nullptr;
};

/// The rays of a camera that is far away from what it shows: in double up to where they come to the sphere, or closest
/// to it, and in float from there on.
inline CameraRays rays_at(const BoundingSphere& sphere, const Ray<Doubles<FloatN>>& rays) {
  using D = Doubles<FloatN>;
  const Vec3<D> to_center = Vec3<D>(sphere.center) - rays.origin;
  const D closest = dot(to_center, rays.direction);
  const Vec3<D> across = to_center - rays.direction * closest;
  const D half_chord = sqrt(max(D(sphere.radius * sphere.radius) - dot(across, across), D(0.0)));
  // Less, by more than its rounding to float.
  const FloatN near = rays.near.to_float();
  const FloatN skipped = max((max(closest - half_chord, D(0.0)) * D(1 - 0x1p-22)).to_float(), near);
  return {{to_float(rays.origin + rays.direction * D(skipped)), to_float(rays.direction), near - skipped,
           infinity<FloatN>()},
          skipped};
}

}  // namespace raytrace
