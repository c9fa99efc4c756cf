// GGX of ggx.h with facets whose slopes differ along x and y of the local frame, as those of brushed metal.
#pragma once

#include "raytrace/bsdfs/ggx.h"

namespace raytrace {

/// T: a batch. Directions are in the local frame.
template <class T>
struct StretchedGgx {
  T alpha_x, alpha_y;

  /// Of OpenPBR's parameters, each in [0, 1]: grooves along y make slopes along x.
  static StretchedGgx of(const T& roughness, const T& anisotropy) {
    const T rest = T(1) - anisotropy, x = roughness * roughness * sqrt(T(2) / (T(1) + rest * rest));
    return {x, max(x * rest, min(x, T(least_alpha)))};
  }
  auto is_rough() const { return alpha_x >= T(least_alpha); }

  /// Of facets that are not stretched and send on about as much.
  T even_roughness() const { return min(sqrt((alpha_x + alpha_y) * T(0.5F)), T(1)); }

  T lambda(const Vec3<T>& w) const {
    const T x = w.x * alpha_x, y = w.y * alpha_y;
    return (sqrt(T(1) + (x * x + y * y) / (w.z * w.z)) - T(1)) * T(0.5F);
  }
  T density(const Vec3<T>& facet) const {
    const T x = facet.x / alpha_x, y = facet.y / alpha_y;
    const T sum = x * x + y * y + max(T(1) - facet.x * facet.x - facet.y * facet.y, T(0));
    return T(1) / (T(std::numbers::pi_v<float>) * alpha_x * alpha_y * sum * sum);
  }
  Vec3<T> sample_facet(const Vec3<T>& wo, const T& u1, const T& u2) const {
    return visible_facet(wo, alpha_x, alpha_y, u1, u2);
  }
  typename Ggx<T>::Reflection reflection(const Vec3<T>& wo, const Vec3<T>& wi) const {
    const Mask<T> is_above = wi.z > T(1e-6F);
    const Vec3<T> sum = wo + wi;
    const Vec3<T> facet = sum * (T(1) / sqrt(max(dot(sum, sum), T(1e-12F))));
    const T cosine_i = max(wi.z, T(1e-6F)), lambda_o = lambda(wo), lambda_i = lambda({wi.x, wi.y, cosine_i});
    const T pdf = density(facet) / (T(4) * wo.z * (T(1) + lambda_o));
    const T f = pdf * (T(1) + lambda_o) / ((T(1) + lambda_o + lambda_i) * cosine_i);
    return {select(is_above, f, T(0)), select(is_above, pdf, T(0)), min(max(dot(wo, facet), T(1e-6F)), T(1))};
  }
};

}  // namespace raytrace
