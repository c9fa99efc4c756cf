// A direction that a BSDF drew.
#pragma once

#include "raytrace/math/color.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// In the local frame of a surface point, where the normal is z and directions point away from the surface.
template <class T>
struct BsdfSample {
  Vec3<T> wi;     ///< unit length, where light comes from; below the surface where it comes through it
  Rgb<T> f;       ///< of wo and wi, in 1/steradian, without the cosine; 0 where no light comes from wi
  T pdf;          ///< density of wi per solid angle: the mean of f |wi.z| / pdf is the share of light that is sent on
  T eta2 = T(1);  ///< what comes through: the square of the index of refraction on wi's side over that on wo's side

  /// Whether wi is one of finitely many directions, as a smooth mirror's is: then pdf is the probability of its choice,
  /// f stands for the integral over the directions about it, and evaluate() and pdf() do not know of it.
  Mask<T> specular{false};

  /// Whether the light goes in below the surface there, is scattered inside, and comes out at another place
  /// (tracing/random_walk.h).
  Mask<T> enters{false};
};

/// Lane by lane: a where the mask is true, else b.
template <class T>
BsdfSample<T> select(const Mask<T>& mask, const BsdfSample<T>& a, const BsdfSample<T>& b) {
  return {select(mask, a.wi, b.wi),
          select(mask, a.f, b.f),
          select(mask, a.pdf, b.pdf),
          select(mask, a.eta2, b.eta2),
          (a.specular & mask) | (b.specular & !mask),
          (a.enters & mask) | (b.enters & !mask)};
}

/// Of what a surface reflects not diffusely: what mirrors nearly as a smooth surface does, or all of it.
enum class Gloss { sharp, any };

/// The normal in the local frame.
template <class T>
Vec3<T> local_normal() {
  return {T(0), T(0), T(1)};
}

}  // namespace raytrace
