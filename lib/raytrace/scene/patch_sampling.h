// Points that light is drawn from, on the pieces that shining surfaces are cut into.
#pragma once

#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

/// A LightPatch in float.
template <class T>
struct PatchRecord {
  T shape;  ///< a PatchShape
  Vec3<T> origin, a, b;
  T material;     ///< its number, counted through all
  T error_scale;  ///< 1, or more where the surface that rays meet is less exactly this one
};

/// Points of patches, one a lane.
struct PatchSample {
  Vec3<FloatN> p, normal;  ///< the normal has unit length, on the front
  FloatN error;            ///< bound of the distance between p and the true surface
  FloatN pdf;              ///< density per solid angle, from where it was drawn for; 0 where the point is on edge
  FloatN u, v;             ///< barycentric coordinates, of triangles
};

/// A point of each lane's patch, drawn out of u1 and u2 in [0, 1) for light that goes to `from`: of spheres that are
/// outside, evenly in solid angle (pbrt-v4, section 6.2.4), of all else, evenly in area; of a torus, in its angles.
PatchSample sample_patch(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const FloatN& u1,
                         const FloatN& u2);

/// The density, per solid angle, at which sample_patch() draws p, where the normal is that.
FloatN patch_pdf(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const Vec3<FloatN>& p,
                 const Vec3<FloatN>& normal);

}  // namespace raytrace
