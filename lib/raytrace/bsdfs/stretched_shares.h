// What ggx_shares.h has, of facets whose slopes differ along x and y.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "raytrace/bsdfs/ggx_shares.h"
#include "raytrace/bsdfs/stretched_ggx.h"

namespace raytrace {

namespace detail {

/// A table by the cosine, the roughness, where wo is between the grooves and the way across them, and the anisotropy.
/// It has the four corners of each cell in the cosine and in that place beside each other: a look-up is four loads a
/// lane.
class StretchedShares {
 public:
  StretchedShares() {
    std::vector<float> shares(sizes[0] * sizes[1] * sizes[2] * sizes[3]);
    std::size_t i = 0;
    std::array<float, axes> step{};
    for (float& share : shares) {
      std::size_t rest = i++;
      for (std::size_t axis = 0; axis < axes; rest /= sizes[axis++])
        step[axis] = static_cast<float>(rest % sizes[axis]) / static_cast<float>(sizes[axis] - 1);
      share = share_at(step);
    }
    i = 0;
    for (std::size_t row = 0; row < sizes[2] * sizes[3]; ++row)
      for (std::size_t place = 0; place + 1 < sizes[1]; ++place)
        for (std::size_t cosine = 0; cosine + 1 < sizes[0]; ++cosine, ++i) {
          const float* const corner = &shares[(row * sizes[1] + place) * sizes[0] + cosine];
          corners_[i] = {corner[0], corner[1], corner[sizes[0]], corner[sizes[0] + 1]};
        }
  }

  FloatN look_up(const StretchedGgx<FloatN>& ggx, const Vec3<FloatN>& wo) const {
    const FloatN &x = ggx.alpha_x, &y = ggx.alpha_y, sine2 = wo.x * wo.x + wo.y * wo.y;
    const FloatN roughness = sqrt(sqrt((x * x + y * y) * FloatN(0.5F))), root = sqrt(wo.z);
    const FloatN slope = sqrt((wo.x * wo.x * x * x + wo.y * wo.y * y * y) / max(sine2, FloatN(1e-12F)));
    const std::array<FloatN, axes> places = {
        ((FloatN(1) + roughness) / (root + roughness) + FloatN(1)) * root * FloatN(0.5F),
        sqrt(max(slope - y, FloatN(0)) / max(x - y, FloatN(1e-6F))), roughness, FloatN(1) - y / x};
    std::array<IntN, axes> cells;
    std::array<FloatN, axes> parts;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const auto last = static_cast<float>(sizes[axis] - 1);
      const FloatN place = min(max(places[axis] * FloatN(last), FloatN(0)), FloatN(last));
      cells[axis] = to_int(min(place, FloatN(last - 0.001F)));
      parts[axis] = place - to_float(cells[axis]);
    }
    const auto between = [](const FloatN& low, const FloatN& high, const FloatN& part) {
      return low + (high - low) * part;
    };
    const auto times = [](const IntN& a, std::size_t b) { return a * IntN(static_cast<std::int32_t>(b)); };
    const IntN row = times(cells[3], sizes[2]) + cells[2];
    const IntN first = times(times(row, sizes[1] - 1) + cells[1], sizes[0] - 1) + cells[0];
    const auto share = [&](std::size_t rows_above) {
      constexpr std::size_t cells_of_row = (sizes[0] - 1) * (sizes[1] - 1);
      alignas(64) std::array<std::int32_t, packet_lanes> offsets;
      (times(first, 4)).store_aligned(offsets.data());
      std::array<FloatN, 4> corner;
      gather_four(corners_[rows_above * cells_of_row].data(), offsets.data(), corner.data());
      return between(between(corner[0], corner[1], parts[0]), between(corner[2], corner[3], parts[0]), parts[1]);
    };
    return between(between(share(0), share(1), parts[2]), between(share(sizes[2]), share(sizes[2] + 1), parts[2]),
                   parts[3]);
  }

 private:
  static constexpr std::size_t axes = 4;
  static constexpr std::array<std::size_t, axes> sizes = {16, 6, 16, 11};

  static float share_at(const std::array<float, axes>& step) {
    const float roughness = std::max(step[2], 0.03F), anisotropy = step[3];
    const auto ggx = StretchedGgx<FloatN>::of(FloatN(roughness), FloatN(anisotropy));
    const float x = ggx.alpha_x.get(0), y = ggx.alpha_y.get(0), slope = y + (x - y) * step[1] * step[1];
    const float across = x > y ? (slope * slope - y * y) / (x * x - y * y) : step[1];  // of the sine, squared
    const float b = 0.5F + roughness - step[0], root = std::sqrt(b * b + 2 * step[0] * roughness) - b;
    const float cosine = std::clamp(root * root, 1e-4F, 1.0F), sine = std::sqrt(1 - cosine * cosine);
    const Vec3<FloatN> wo(Vec3f{sine * std::sqrt(across), sine * std::sqrt(1 - across), cosine});
    return mean_over_facets<24>(wo, ggx, 1, [&](const Vec3<FloatN>& from, const Vec3<FloatN>& facet) {
      const Vec3<FloatN> wi = facet * (FloatN(2) * dot(from, facet)) - from;
      const FloatN lambda_o = ggx.lambda(from), lambda_i = ggx.lambda({wi.x, wi.y, max(wi.z, FloatN(1e-6F))});
      return select(wi.z > FloatN(0), (FloatN(1) + lambda_o) / (FloatN(1) + lambda_o + lambda_i), FloatN(0));
    });
  }

  std::array<std::array<float, 4>, (sizes[0] - 1) * (sizes[1] - 1) * sizes[2] * sizes[3]> corners_;
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
