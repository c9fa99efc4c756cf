// What ggx_shares.h has, of facets whose slopes differ along x and y.
#pragma once

#include <array>
#include <cmath>

#include "raytrace/bsdfs/ggx_shares.h"
#include "raytrace/bsdfs/stretched_ggx.h"

namespace raytrace {

namespace detail {

/// A table by the cosine, the roughness, where wo is between the grooves and the way across them, and the anisotropy.
class StretchedShares {
 public:
  StretchedShares() {
    std::size_t i = 0;
    std::array<float, axes> step{};
    for (float& share : shares_) {
      std::size_t rest = i++;
      for (std::size_t axis = 0; axis < axes; rest /= sizes[axis++])
        step[axis] = static_cast<float>(rest % sizes[axis]) / static_cast<float>(sizes[axis] - 1);
      share = share_at(step);
    }
  }

  FloatN look_up(const StretchedGgx<FloatN>& ggx, const Vec3<FloatN>& wo) const {
    const FloatN &x = ggx.alpha_x, &y = ggx.alpha_y, sine2 = wo.x * wo.x + wo.y * wo.y;
    const FloatN roughness = sqrt(sqrt((x * x + y * y) * FloatN(0.5F))), root = sqrt(wo.z);
    const FloatN slope = sqrt((wo.x * wo.x * x * x + wo.y * wo.y * y * y) / max(sine2, FloatN(1e-12F)));
    const std::array<FloatN, axes> places = {
        ((FloatN(1) + roughness) / (root + roughness) + FloatN(1)) * root * FloatN(0.5F), roughness,
        sqrt(max(slope - y, FloatN(0)) / max(x - y, FloatN(1e-6F))), FloatN(1) - y / x};
    std::array<IntN, axes> cells;
    std::array<FloatN, axes> parts;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const auto last = static_cast<float>(sizes[axis] - 1);
      const FloatN place = min(max(places[axis] * FloatN(last), FloatN(0)), FloatN(last));
      cells[axis] = to_int(min(place, FloatN(last - 0.001F)));
      parts[axis] = place - to_float(cells[axis]);
    }
    FloatN share(0);
    for (unsigned corner = 0; corner < 1U << axes; ++corner) {
      FloatN weight(1);
      IntN index(0);
      for (std::size_t axis = axes; axis-- > 0;) {
        const bool above = (corner >> axis & 1U) != 0;
        weight = weight * (above ? parts[axis] : FloatN(1) - parts[axis]);
        index = index * IntN(static_cast<std::int32_t>(sizes[axis])) + cells[axis] + IntN(above ? 1 : 0);
      }
      share += weight * gather(shares_.data(), index);
    }
    return share;
  }

 private:
  static constexpr std::size_t axes = 4;
  static constexpr std::array<std::size_t, axes> sizes = {16, 16, 6, 11};

  static float share_at(const std::array<float, axes>& step) {
    const float roughness = std::max(step[1], 0.03F), anisotropy = step[3];
    const auto ggx = StretchedGgx<FloatN>::of(FloatN(roughness), FloatN(anisotropy));
    const float x = ggx.alpha_x.get(0), y = ggx.alpha_y.get(0), slope = y + (x - y) * step[2] * step[2];
    const float across = x > y ? (slope * slope - y * y) / (x * x - y * y) : step[2];  // of the sine, squared
    const float b = 0.5F + roughness - step[0], root = std::sqrt(b * b + 2 * step[0] * roughness) - b;
    const float cosine = std::clamp(root * root, 1e-4F, 1.0F), sine = std::sqrt(1 - cosine * cosine);
    const Vec3<FloatN> wo(Vec3f{sine * std::sqrt(across), sine * std::sqrt(1 - across), cosine});
    return mean_over_facets<24>(wo, ggx, 1, [&](const Vec3<FloatN>& from, const Vec3<FloatN>& facet) {
      const Vec3<FloatN> wi = facet * (FloatN(2) * dot(from, facet)) - from;
      const FloatN lambda_o = ggx.lambda(from), lambda_i = ggx.lambda({wi.x, wi.y, max(wi.z, FloatN(1e-6F))});
      return select(wi.z > FloatN(0), (FloatN(1) + lambda_o) / (FloatN(1) + lambda_o + lambda_i), FloatN(0));
    });
  }

  std::array<float, sizes[0] * sizes[1] * sizes[2] * sizes[3]> shares_;
};

}  // namespace detail

/// Of facets that reflect all light, from wo in the local frame: to about a hundredth.
inline FloatN stretched_reflected_share(const StretchedGgx<FloatN>& ggx, const Vec3<FloatN>& wo) {
  static const detail::StretchedShares table;
  return table.look_up(ggx, wo);
}

/// What they reflect alone where each does as a boundary of that eta, by a few of them.
inline FloatN stretched_dielectric_reflection(const StretchedGgx<FloatN>& ggx, const Vec3<FloatN>& wo,
                                              const FloatN& eta) {
  const FloatN lambda_o = ggx.lambda(wo), least(1e-6F);
  FloatN sum(0);
  for (int i = 0; i < FacetLattice::count; ++i) {
    const float root = FacetLattice::height(i);
    const Vec3<FloatN> facet = ggx.sample_facet(wo, FloatN(FacetLattice::turn(i)), FloatN(1 - root * root));
    const FloatN c = dot(wo, facet);
    const Vec3<FloatN> wi = facet * (FloatN(2) * c) - wo;
    const FloatN lambda_i = ggx.lambda({wi.x, wi.y, max(wi.z, least)});
    const FloatN reflected = fresnel_reflection(min(max(c, FloatN(0)), FloatN(1)), eta).reflectance *
                             (FloatN(1) + lambda_o) / (FloatN(1) + lambda_o + lambda_i);
    sum += select(wi.z > FloatN(0), reflected, FloatN(0)) * FloatN(root * 2 / FacetLattice::count);
  }
  return sum;
}

}  // namespace raytrace
