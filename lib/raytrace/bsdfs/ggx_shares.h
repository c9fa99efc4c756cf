// How much of the light rough surfaces send on when it meets one facet alone: what is shadowed by others is lost, and
// would have gone on to meet further ones. BSDFs divide by it, so that they lose nothing (Turquin, "Practical multiple
// scattering compensation for microfacet models", 2019). Then f is not quite reciprocal: it is divided by wo's share.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>

#include "raytrace/bsdfs/fresnel.h"
#include "raytrace/bsdfs/ggx.h"
#include "raytrace/math/color.h"
#include "raytrace/math/gather.h"

namespace raytrace {

namespace detail {

/// The axes of tables: roughness from that of the least alpha to 1, and a function of it and of the cosine. Half its
/// steps are even ones of the cosine's root, for what Fresnel's equations let through; the other half goes to what the
/// facets shadow, at grazing angles alone where they are the least rough.
class ShareAxes {
 public:
  static constexpr int steps = 32, size = steps * steps;

  /// table: of `size` numbers, the lanes' own being at `first`.
  static FloatN look_up(const float* table, const IntN& first, const FloatN& cosine, const FloatN& roughness) {
    const FloatN root = sqrt(cosine);
    const FloatN x = (roughness - FloatN(least)) * FloatN((steps - 1) / (1 - least));
    const FloatN y = ((FloatN(1) + roughness) / (root + roughness) + FloatN(1)) * root * FloatN(0.5F * (steps - 1));
    const IntN column = cell(x), row = cell(y);
    const FloatN right = x - to_float(column), up = y - to_float(row);
    const IntN at = first + column * IntN(steps) + row;
    const auto between = [&](int offset) {
      const FloatN low = gather(table + offset, at), high = gather(table + offset + 1, at);
      return low + (high - low) * up;
    };
    const FloatN left = between(0);
    return left + (between(steps) - left) * right;
  }

  /// share(cosine, roughness) at all steps.
  template <class Share>
  static void fill(float* table, const Share& share) {
    for (int column = 0; column < steps; ++column)
      for (int row = 0; row < steps; ++row) {
        const float roughness = least + static_cast<float>(column) * (1 - least) / (steps - 1);
        const float y = static_cast<float>(row) / (steps - 1);
        const float b = 0.5F + roughness - y, root = std::sqrt(b * b + 2 * y * roughness) - b;
        table[column * steps + row] = share(std::clamp(root * root, 1e-4F, 1.0F), roughness);
      }
  }

 private:
  static constexpr float least = 0.0316227766F;  // its square is the least alpha

  static IntN cell(const FloatN& x) { return to_int(min(max(x, FloatN(0)), FloatN(steps - 1.001F))); }
};

inline float sum_of_lanes(const FloatN& numbers) {
  float sum = 0;
  for (std::size_t lane = 0; lane < packet_lanes; ++lane) sum += numbers.get(lane);
  return sum;
}

/// The mean of scattered(wo, facet) over the facets that are visible from wo. circle: the part of it that has all: a
/// half where both sides of the plane of wo and the normal are alike, else 1.
template <int heights, class Facets, class Scattered>
float mean_over_facets(const Vec3<FloatN>& wo, const Facets& ggx, float circle, const Scattered& scattered) {
  // A midpoint rule of as many angles, and steps from the tail of the facets' slopes.
  constexpr int turns = 32;
  FloatN sum(0);
  for (int first = 0; first < turns * heights; first += packet_lanes) {
    const FloatN number = lane_numbers<FloatN>() + FloatN(static_cast<float>(first) + 0.5F);
    const FloatN height = floor(number * FloatN(1.0F / turns));
    const FloatN turn = (number - height * FloatN(turns)) * FloatN(circle / turns);
    const FloatN root = (height + FloatN(0.5F)) * FloatN(1.0F / heights);
    sum += scattered(wo, ggx.sample_facet(wo, turn, FloatN(1) - root * root)) * root;
  }
  return sum_of_lanes(sum) * 2 / (turns * heights);
}

template <class Scattered>
float mean_over_facets(float cosine, const Ggx<FloatN>& ggx, const Scattered& scattered) {
  const Vec3<FloatN> wo(Vec3f{std::sqrt(1 - cosine * cosine), 0, cosine});
  return mean_over_facets<48>(wo, ggx, 0.5F, scattered);
}

/// Of what a facet of that normal reflects.
inline FloatN unshadowed_reflection(const Ggx<FloatN>& ggx, const Vec3<FloatN>& wo, const Vec3<FloatN>& facet) {
  const FloatN z = FloatN(2) * dot(wo, facet) * facet.z - wo.z;
  return select(z > FloatN(0), ggx.unshadowed(ggx.lambda(wo.z), ggx.lambda(max(z, FloatN(1e-6F)))), FloatN(0));
}

}  // namespace detail

/// Of facets that reflect all light, from a direction of that cosine. The roughness is the root of alpha.
inline FloatN ggx_reflected_share(const FloatN& cosine, const FloatN& roughness) {
  static const auto table = [] {
    std::array<float, detail::ShareAxes::size> shares{};
    detail::ShareAxes::fill(shares.data(), [](float cosine_o, float rough) {
      const Ggx<FloatN> ggx{FloatN(rough * rough)};
      return detail::mean_over_facets(cosine_o, ggx, [&](const Vec3<FloatN>& wo, const Vec3<FloatN>& facet) {
        return detail::unshadowed_reflection(ggx, wo, facet);
      });
    });
    return shares;
  }();
  return detail::ShareAxes::look_up(table.data(), IntN(0), cosine, roughness);
}

namespace detail {

/// Tables of `size` numbers one behind the other, each made when it is wanted first, since scenes have few.
template <int layers, int size>
class LazyLayers {
 public:
  const float* data() const { return numbers_.data(); }

  /// fill(layer, numbers): what makes it.
  template <class Fill>
  void make(int layer, const Fill& fill) {
    const auto index = static_cast<std::size_t>(layer);
    if (is_made_[index].load(std::memory_order_acquire)) return;
    const std::lock_guard lock(making_);
    if (is_made_[index].load(std::memory_order_relaxed)) return;
    fill(layer, &numbers_[index * size]);
    is_made_[index].store(true, std::memory_order_release);
  }

 private:
  std::mutex making_;
  std::array<std::atomic<bool>, std::size_t{layers}> is_made_{};
  std::array<float, std::size_t{layers} * size> numbers_{};
};

/// Of facets between two clear media, for steps of eta: each made when it is wanted first, since scenes have few.
/// reflection: of what they reflect alone.
template <bool reflection>
class DielectricShares {
 public:
  // Even steps of the root of |eta - 1| / (eta + 1), since total reflection starts suddenly: to either side of an eta
  // of 1 as many as the root needs to come to 1, of which `unit` are the size of `unit_root`.
  static constexpr int unit = 48, most = 72, layers = 2 * most + 1;
  static constexpr float unit_root = 0.67F;

  /// From the layer's first number on.
  const float* shares() const { return layers_.data(); }

  void make(int layer) { layers_.make(layer, fill); }

 private:
  static void fill(int layer, float* shares) {
    const float step = static_cast<float>(layer - most) / unit * unit_root;
    const float x = std::clamp(step * std::abs(step), -0.99999F, 0.99999F);
    const FloatN eta((1 + x) / (1 - x));
    ShareAxes::fill(shares, [&](float cosine, float roughness) {
      const Ggx<FloatN> ggx{FloatN(roughness * roughness)};
      return mean_over_facets(cosine, ggx, [&](const Vec3<FloatN>& wo, const Vec3<FloatN>& facet) {
        const FloatN c = min(max(dot(wo, facet), FloatN(0)), FloatN(1));
        const FresnelReflection<FloatN> fresnel = fresnel_reflection(c, eta);
        if constexpr (reflection) return fresnel.reflectance * unshadowed_reflection(ggx, wo, facet);
        const FloatN below = wo.z / eta - facet.z * (c / eta - fresnel.transmitted_cosine);
        const FloatN refracted = select(
            below > FloatN(0), ggx.unshadowed(ggx.lambda(wo.z), ggx.lambda(max(below, FloatN(1e-6F)))), FloatN(0));
        return fresnel.reflectance * unshadowed_reflection(ggx, wo, facet) +
               (FloatN(1) - fresnel.reflectance) * refracted;
      });
    });
  }

  LazyLayers<layers, ShareAxes::size> layers_;
};

}  // namespace detail

/// Of facets that reflect and refract as a boundary of that eta does (fresnel.h). reflection: what they reflect alone.
template <bool reflection = false>
FloatN ggx_dielectric_share(const FloatN& cosine, const FloatN& roughness, const FloatN& eta) {
  using DielectricShares = detail::DielectricShares<reflection>;
  static DielectricShares table;
  const FloatN x = (eta - FloatN(1)) / (eta + FloatN(1));
  const FloatN size = min(sqrt(abs(x)), FloatN(1)) * FloatN(1 / DielectricShares::unit_root);
  const FloatN height = (FloatN(1) + select(x < FloatN(0), -size, size)) * FloatN(DielectricShares::unit);
  const FloatN below = floor(height);
  const IntN layer = to_int(below) + IntN(DielectricShares::most - DielectricShares::unit);
  const LaneIndices numbers(layer);
  for (std::size_t lane = 0; lane < (numbers.all_same() ? 1 : packet_lanes); ++lane) {
    table.make(layer.get(lane));
    table.make(layer.get(lane) + 1);
  }
  const auto at = [&](const IntN& number) {
    return detail::ShareAxes::look_up(table.shares(), number * IntN(detail::ShareAxes::size), cosine, roughness);
  };
  const FloatN low = at(layer);
  return low + (at(layer + IntN(1)) - low) * (height - below);
}

/// What facets send on, and of it what they reflect.
struct GgxShares {
  Rgb<FloatN> all, reflected;
};

/// Points of the unit square, the first number of each that of turns and the second that of heights.
class FacetGrid {
 public:
  static constexpr int count = 20;
  static float turn(int i) { return (static_cast<float>(i / heights) + 0.5F) * (static_cast<float>(heights) / count); }
  static float height(int i) { return (static_cast<float>(i % heights) + 0.5F) / heights; }

 private:
  static constexpr int heights = 5;
};
/// More of them, no two of one height, for what changes suddenly.
class FacetLattice {
 public:
  static constexpr int count = 233;
  static float turn(int i) {
    const float step = (static_cast<float>(i) + 0.5F) * 0.61803399F;
    return step - std::floor(step);
  }
  static float height(int i) { return (static_cast<float>(i) + 0.5F) / count; }
};

/// How much of that changes where each facet's reflectance is another than fresnel_reflection() has, by few facets.
/// reflectance(cosine): of one.
template <class Points = FacetGrid, class Reflectance>
GgxShares ggx_share_changes(const FloatN& cosine, const FloatN& roughness, const FloatN& eta,
                            const Reflectance& reflectance) {
  const Ggx<FloatN> ggx{roughness * roughness};
  const Vec3<FloatN> wo{sqrt(max(FloatN(1) - cosine * cosine, FloatN(0))), FloatN(0), max(cosine, FloatN(1e-4F))};
  const FloatN lambda_o = ggx.lambda(wo.z), zero(0), one(1), least(1e-6F);
  GgxShares sum{{zero, zero, zero}, {zero, zero, zero}};
  for (int i = 0; i < Points::count; ++i) {
    const float root = Points::height(i);
    const FloatN turn(Points::turn(i) * 0.5F), weight(root * 2 / Points::count);
    const Vec3<FloatN> facet = ggx.sample_facet(wo, turn, FloatN(1 - root * root));
    const FloatN c = min(max(dot(wo, facet), zero), one);
    const FresnelReflection<FloatN> bare = fresnel_reflection(c, eta);
    const FloatN below = wo.z / eta - facet.z * (c / eta - bare.transmitted_cosine);
    const FloatN through = select(below > zero, ggx.unshadowed(lambda_o, ggx.lambda(max(below, least))) * weight, zero);
    const FloatN reflected = detail::unshadowed_reflection(ggx, wo, facet) * weight;
    const Rgb<FloatN> change = reflectance(c) + Rgb<FloatN>(-bare.reflectance, -bare.reflectance, -bare.reflectance);
    sum.reflected += change * reflected;
    sum.all += change * (reflected - through);
  }
  return sum;
}

}  // namespace raytrace
