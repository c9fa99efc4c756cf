// Rough diffuse reflection that loses no energy: EON (Portsmouth, Kutz and Hill, "EON: A practical energy-preserving
// rough diffuse BRDF", JCGT 2025). Fujii's variant of Oren and Nayar's model, and what bounces between its facets.
#pragma once

#include <numbers>

#include "raytrace/math/color.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// T: a batch.
template <class T>
struct OrenNayar {
  Rgb<T> color;  ///< of a facet
  T roughness;   ///< in [0, 1]; 0: Lambertian

  /// The BRDF, without the cosine, in the local frame, of directions above the surface.
  Rgb<T> f(const Vec3<T>& wo, const Vec3<T>& wi) const {
    constexpr float pi = std::numbers::pi_v<float>;
    const T s = wo.x * wi.x + wo.y * wi.y, share = one_facet();
    const T t = select(s > T(0), max(max(wo.z, wi.z), T(1e-6F)), T(1));
    const T single = share * (T(1) + roughness * s / t) * T(1 / pi);
    const T mean = share * (T(1) + roughness * T(2.0F / 3 - 28 / (15 * pi)));
    const T lost = max(T(1) - mean, T(1e-6F));
    const T others = max(T(1) - albedo(wo.z), T(0)) * max(T(1) - albedo(wi.z), T(0)) * mean / lost * T(1 / pi);
    const auto channel = [&](const T& c) { return c * (single + others * c / (T(1) - c * lost)); };
    return {channel(color.red), channel(color.green), channel(color.blue)};
  }

 private:
  T one_facet() const { return T(1) / (T(1) + roughness * T(0.5F - 2 / (3 * std::numbers::pi_v<float>))); }
  /// What white facets send on of light that meets one of them.
  T albedo(const T& cosine) const {
    const T c = min(max(cosine, T(1e-4F)), T(1)), sine = sqrt(max(T(1) - c * c, T(0)));
    const T angle = atan2(sine, c);
    const T g = sine * (angle - sine * c) + T(2.0F / 3) * (sine / c * (T(1) - sine * sine * sine) - sine);
    return one_facet() * (T(1) + roughness * g * T(1 / std::numbers::pi_v<float>));
  }
};

}  // namespace raytrace
