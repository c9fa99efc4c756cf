// Surfaces of many tiny facets, each smooth, whose normals follow GGX's distribution, with Smith's masking and
// shadowing (Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; Heitz,
// "Understanding the Masking-Shadowing Function", JCGT 2014).
#pragma once

#include <numbers>

#include "raytrace/bsdfs/bsdf_sample.h"
#include "raytrace/bsdfs/least_alpha.h"
#include "raytrace/math/turns.h"

namespace raytrace {

/// wo as BSDFs want it, clearly above the surface: shading normals may be such that it is not.
template <class T>
Vec3<T> above_surface(const Vec3<T>& wo, const Vec3<T>& normal) {
  const T cosine = dot(wo, normal);
  return wo + normal * (max(abs(cosine), T(1e-5F)) - cosine);
}

/// The normal of a facet that is visible from wo, in the local frame, out of u1 and u2 in [0, 1): Dupuy and Benyoub,
/// "Sampling Visible GGX Normals with Spherical Caps", HPG 2023. The facets' slopes are alpha_x along x, alpha_y along
/// y. T: a batch.
template <class T>
Vec3<T> visible_facet(const Vec3<T>& wo, const T& alpha_x, const T& alpha_y, const T& u1, const T& u2) {
  const Vec3<T> stretched = normalize(Vec3<T>{wo.x * alpha_x, wo.y * alpha_y, wo.z});
  const T z = (T(1) - u2) * (T(1) + stretched.z) - stretched.z;
  const T sine = sqrt(max(T(1) - z * z, T(0)));
  const SineAndCosine<T> turn = sin_cos_of_turns(u1);
  const Vec3<T> half{sine * turn.cosine + stretched.x, sine * turn.sine + stretched.y, z + stretched.z};
  return normalize(Vec3<T>{half.x * alpha_x, half.y * alpha_y, max(half.z, T(1e-6F))});
}

/// T: a batch.
template <class T>
struct Ggx {
  T alpha;  ///< slope: the root of the mean square of the facets', about

  auto is_rough() const { return alpha >= T(least_alpha); }

  /// Smith's function: of the facets that face a direction of that cosine, 1 / (1 + lambda) are visible from it.
  T lambda(const T& cosine) const {
    const T square = cosine * cosine;
    return (sqrt(T(1) + alpha * alpha * (max(T(1) - square, T(0)) / square)) - T(1)) * T(0.5F);
  }
  /// The share of what the facets send from wo to wi that is not shadowed.
  T unshadowed(const T& lambda_o, const T& lambda_i) const { return (T(1) + lambda_o) / (T(1) + lambda_o + lambda_i); }

  /// Of normals, for a unit of the surface and per solid angle. squared_sine: of their angle with the surface's.
  T density(const T& squared_sine) const {
    const T square = alpha * alpha;
    const T sum = square * max(T(1) - squared_sine, T(0)) + squared_sine;  // no difference of what is almost the same
    return square / (T(std::numbers::pi_v<float>) * sum * sum);
  }

  /// visible_facet() of wo, in the local frame.
  Vec3<T> sample_facet(const Vec3<T>& wo, const T& u1, const T& u2) const {
    return visible_facet(wo, alpha, alpha, u1, u2);
  }

  struct Reflection {
    T f;       ///< of facets that reflect all light, without the cosine; 0 where wi is below the surface
    T pdf;     ///< of wi, if it is wo's mirror image in a facet that sample_facet() gave
    T cosine;  ///< of wo and that facet

    friend Reflection select(const Mask<T>& mask, const Reflection& a, const Reflection& b) {
      return {select(mask, a.f, b.f), select(mask, a.pdf, b.pdf), select(mask, a.cosine, b.cosine)};
    }
  };
  /// wo: as from above_surface(); directions of unit length, in any frame.
  Reflection reflection(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& normal) const {
    const T cosine_o = dot(wo, normal), cosine_i = dot(wi, normal);
    const Mask<T> is_above = cosine_i > T(1e-6F);
    const Vec3<T> sum = wo + wi;
    const Vec3<T> facet = sum * (T(1) / sqrt(max(dot(sum, sum), T(1e-12F))));
    const Vec3<T> across = cross(facet, normal);
    const T lambda_o = lambda(cosine_o), lambda_i = lambda(max(cosine_i, T(1e-6F)));
    const T pdf = density(dot(across, across)) / (T(4) * cosine_o * (T(1) + lambda_o));
    const T f = pdf * unshadowed(lambda_o, lambda_i) / max(cosine_i, T(1e-6F));
    return {select(is_above, f, T(0)), select(is_above, pdf, T(0)), min(max(dot(wo, facet), T(1e-6F)), T(1))};
  }
};

}  // namespace raytrace
