// Glossy specular reflection, Phong's lobe about the mirror direction (Suffern, chapter 15).
//
// The lobe is not normalised, as in the book: a larger exponent makes the highlight smaller, not brighter.
#pragma once

#include <numbers>

#include "raytrace/bsdfs/direction_about.h"
#include "raytrace/math/color.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// T: float, or a batch for lanes with different surfaces.
template <class T>
struct GlossySpecular {
  Rgb<T> reflectance;  ///< coefficient times colour
  T exponent;

  /// The BRDF, without the cosine: reflectance * max(0, r.wo)^exponent, with r the mirror of wi about the normal.
  /// wo, wi, normal: unit vectors that point away from the surface.
  Rgb<T> f(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& normal) const {
    const T cosine = dot(mirror_of(wi, normal), wo);
    if (none(cosine > T(0))) return {T(0), T(0), T(0)};
    return reflectance * lobe(cosine);
  }

  /// The share of light from straight above that is reflected, the largest of all directions:
  /// the integral of f cos = cos^(exponent + 1) over the hemisphere.
  Rgb<T> rho() const { return reflectance * (T(2 * std::numbers::pi_v<float>) / (exponent + T(2))); }

  /// A direction wi for light to come from, out of u1, u2 in [0, 1): distributed like the lobe over the half of the
  /// sphere about wo's mirror direction. T is a batch. wo, normal: unit vectors that point away from the surface, in
  /// the frame that wi is wanted in. Unless wo is straight above, a part of the lobe lies below the surface, and so do
  /// its samples, dot(normal, wi) <= 0. No light comes from there: such a sample counts, with a value of zero. (Drawing
  /// again instead would change the density.)
  Vec3<T> sample(const Vec3<T>& wo, const Vec3<T>& normal, const T& u1, const T& u2) const {
    const T logarithm = log(T(1) - u1) / (exponent + T(1));
    // cosine^2 + sine^2 = 1 without the cancellation that a narrow lobe would suffer.
    return direction_about(mirror_of(wo, normal), exp(logarithm), sqrt(-expm1(logarithm * T(2))), u2);
  }

  /// The density at which sample() draws wi, in 1/steradian (per solid angle) and without the cosine of the surface:
  /// (exponent + 1) / (2 pi) max(0, r.wi)^exponent, with r the mirror of wo. Its integral over the whole sphere is 1; 0
  /// only outside the lobe, where no sample falls but by rounding at its rim.
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& normal) const {
    return lobe(dot(mirror_of(wo, normal), wi)) * (exponent + T(1)) * T(std::numbers::inv_pi_v<float> / 2);
  }

 private:
  static Vec3<T> mirror_of(const Vec3<T>& w, const Vec3<T>& normal) { return normal * (T(2) * dot(normal, w)) - w; }

  /// max(0, cosine)^exponent
  T lobe(const T& cosine) const {
    // 0 has no logarithm, and a cosine rounded above 1 would grow with the exponent.
    return select(cosine > T(0), pow(min(max(cosine, T(1e-30f)), T(1)), exponent), T(0));
  }
};

}  // namespace raytrace
