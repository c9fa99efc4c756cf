// Points that light is drawn from, on the pieces that shining surfaces are cut into.
#pragma once

#include <bit>
#include <cstdint>

#include "raytrace/math/simd.h"
#include "raytrace/math/vec2.h"
#include "raytrace/math/vec3.h"
#include "raytrace/scene/patch_shares.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

/// A LightPatch in float.
template <class T>
struct PatchRecord {
  Vec3<T> origin, a, b;
  T code;  ///< the bits of a PatchCode
};

/// What a patch is, in 32 bits.
struct PatchCode {
  static constexpr int shape_bits = 3, material_shift = 4;
  static constexpr std::int32_t instanced = 8;  ///< the surface that rays meet is less exactly the patch

  static float of(PatchShape shape, std::int32_t material, bool is_instanced) {
    const std::int32_t code = static_cast<std::int32_t>(shape) + (is_instanced ? instanced : 0);
    return std::bit_cast<float>(code + (material << material_shift));
  }
  static PatchShape shape_of(float code) {
    return static_cast<PatchShape>(std::bit_cast<std::int32_t>(code) & ((1 << shape_bits) - 1));
  }
  /// Its number, counted through all.
  static IntN material_of(const FloatN& code) { return same_bits<IntN>(code) >> material_shift; }
};

/// The shares of patches, and the lanes' patches among them.
struct PatchTextures {
  const PatchShares& shares;
  IntN patch;
};

/// Points of patches, one a lane.
struct PatchSample {
  Vec3<FloatN> p, normal;  ///< the normal has unit length, on the front
  Vec3<FloatN>
      way;  ///< to p from where it was drawn for, in the direction that pdf is of, of which p - from has lost digits
  FloatN error;  ///< bound of the distance between p and the true surface
  FloatN pdf;    ///< density per solid angle, from where it was drawn for; 0 where the point is on edge
  FloatN u, v;   ///< barycentric coordinates, of triangles
};

/// A point of each lane's patch, drawn out of u1 and u2 in [0, 1) for light that goes to `from`: of spheres that `from`
/// is outside of (pbrt-v4, section 6.2.4), and of parallelograms and triangles that are near, evenly in solid angle; of
/// all else, evenly in area; of a torus, in its angles; of an ellipsoid, as of the unit sphere that is mapped to it.
///
/// Flat patches: Peters, "BRDF Importance Sampling for Polygonal Lights", 2021, section 3. Near are those that cover
/// more than about 0.01 of solid angle, from points that are not about in their planes: for others floats do not
/// tell directions apart well enough, and either way is as good.
///
/// Those of flat patches whose textures are uneven are drawn evenly in light, or, where they are so near that they
/// cover more than about 0.2, by half evenly in solid angle: there what sends out little may bring as much.
PatchSample sample_patch(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const FloatN& u1, const FloatN& u2,
                         const PatchTextures* textures = nullptr);

/// The density, per solid angle, at which sample_patch() draws p, where the normal is that.
FloatN patch_pdf(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const Vec3<FloatN>& p,
                 const Vec3<FloatN>& normal, const PatchTextures* textures = nullptr);

}  // namespace raytrace
