// Fibers that stand on a surface, of dust and textiles: they are bright at grazing angles. Zeltner, Burley and Chiang,
// "Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines", SIGGRAPH Talks 2022, whose fits of
// simulated layers are polynomials here: within 0.005 on average of what is reflected.
#pragma once

#include <array>
#include <numbers>

#include "raytrace/math/turns.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// For light that leaves in a direction. T: a batch.
template <class T>
struct Fuzz {
  T albedo;  ///< the share of light that white fibers reflect; the rest goes on to what they stand on

  Fuzz() = default;
  /// wo: in the local frame. roughness: in [0, 1], from thin upright fibers to dust.
  Fuzz(const Vec3<T>& wo, const T& roughness) {
    const T x = min(max(wo.z, T(0)), T(1)), y = min(max(roughness, T(0.1F)), T(1)), q = T(1) / y;
    const auto polynomial = [](const T& at, const auto&... coefficients) {
      const std::array all{coefficients...};
      T sum(all.back());
      for (std::size_t i = all.size() - 1; i-- > 0;) sum = sum * at + T(all[i]);
      return sum;
    };
    albedo = exp(polynomial(q, -0.23776F, -0.088503F, 0.019231F, -0.0014083F) +
                 x * (polynomial(q, 1.0475F, -1.9043F, 0.14979F, -0.011667F) +
                      x * polynomial(q, 0.56915F, -0.5161F, 0.028264F, -0.14687F)));
    scale_ = polynomial(y, 0.03087F, -0.1862F, 1.535F, -0.6484F) +
             x * (polynomial(y, 0.6428F, 1.113F, -1.049F) + x * (polynomial(y, -1.29F, 0.1263F) + x * T(0.6015F)));
    shear_ = polynomial(y, 0.002211F, -0.7037F, 0.5785F, 0.1349F) +
             x * (polynomial(y, 0.8175F, -0.4869F, -0.3613F) + x * (polynomial(y, -0.8718F, 0.7613F) + x * T(0.1655F)));
    const T sine2 = wo.x * wo.x + wo.y * wo.y, inverse = T(1) / sqrt(max(sine2, T(1e-12F)));
    const auto leans = sine2 > T(1e-12F);
    cosine_ = select(leans, wo.x * inverse, T(1));
    sine_ = select(leans, wo.y * inverse, T(0));
  }

  /// The density of sample() per solid angle, over the cosine: f of white fibers is albedo times it.
  T density(const Vec3<T>& wi) const {
    const T x = cosine_ * wi.x + sine_ * wi.y, y = cosine_ * wi.y - sine_ * wi.x;
    const T sheared = scale_ * x + shear_ * wi.z;
    const T square = scale_ * scale_, sum = sheared * sheared + square * y * y + wi.z * wi.z;
    return square / (sum * sum * T(std::numbers::pi_v<float>));
  }

  Vec3<T> sample(const T& u1, const T& u2) const {
    const SineAndCosine<T> turn = sin_cos_of_turns(u2);
    const T root = sqrt(u1), z = sqrt(T(1) - u1);
    const T x = (root * turn.cosine - z * shear_) / scale_, y = root * turn.sine / scale_;
    return normalize(Vec3<T>{cosine_ * x - sine_ * y, sine_ * x + cosine_ * y, z});
  }

 private:
  T scale_, shear_;  // what makes a cosine lobe of it, where wo has no y
  T cosine_, sine_;  // of wo about the normal
};

}  // namespace raytrace
