// What rough boundaries reflect of light on the denser side: all of it beyond the critical angle, and just within it
// soon hardly any.
#pragma once

#include "raytrace/bsdfs/ggx_shares.h"

namespace raytrace {

namespace detail {

/// The mean reflectance of the facets that light meets and is not shadowed from, for steps of eta, of which each is
/// made when it is wanted first. The cosine's axis has a knot at the critical angle: to either side of it, reflectance
/// is smooth over the root of the distance to it, with facets that blur it over about their roughness.
class TotalReflection {
 public:
  // The axes are even in the root of roughness, and in the root of what DielectricShares has even steps of.
  static constexpr int columns = 32, rows = 48, size = columns * (2 * rows + 1), layers = 49, facets = 1536;

  FloatN look_up(const FloatN& cosine, const FloatN& roughness, const FloatN& eta) {
    const FloatN x = max((FloatN(1) - eta) / (FloatN(1) + eta), FloatN(0));
    const FloatN height = min(sqrt(sqrt(x)) * FloatN(layers - 1), FloatN(layers - 1.001F));
    const IntN layer = to_int(height);
    const LaneIndices numbers(layer);
    for (std::size_t lane = 0; lane < (numbers.all_same() ? 1 : packet_lanes); ++lane)
      for (const int next : {0, 1}) layers_.make(layer.get(lane) + next, fill);
    const FloatN critical = sqrt(max(FloatN(1) - eta * eta, FloatN(0)));
    const MaskN beyond = cosine < critical;
    const FloatN distance = abs(cosine - critical) / max(select(beyond, critical, FloatN(1) - critical), FloatN(1e-6F));
    const FloatN root = sqrt(min(distance, FloatN(1)));
    const FloatN part = ((FloatN(1) + roughness) / (root + roughness) + FloatN(1)) * root * FloatN(0.5F * rows);
    const FloatN row = FloatN(rows) + select(beyond, -part, part);
    const FloatN column = (sqrt(roughness) - FloatN(least)) * FloatN((columns - 1) / (1 - least));
    const IntN low_row = cell(row, 2 * rows), low_column = cell(column, columns - 1);
    const FloatN up = row - to_float(low_row), right = column - to_float(low_column), on = height - to_float(layer);
    const IntN at = layer * IntN(size) + low_column * IntN(2 * rows + 1) + low_row;
    const auto mixed = [](const FloatN& a, const FloatN& b, const FloatN& t) { return a + (b - a) * t; };
    const auto along = [&](int offset) {
      return mixed(gather(layers_.data() + offset, at), gather(layers_.data() + offset + 1, at), up);
    };
    const auto across = [&](int offset) { return mixed(along(offset), along(offset + 2 * rows + 1), right); };
    return mixed(across(0), across(size), on);
  }

 private:
  static constexpr float least = 0.177827941F;  // its fourth power is the least alpha

  static IntN cell(const FloatN& x, int last) {
    return to_int(min(max(x, FloatN(0)), FloatN(static_cast<float>(last) - 0.001F)));
  }
  static void fill(int layer, float* shares) {
    const float step = static_cast<float>(layer) / (layers - 1), x = std::min(step * step * step * step, 0.99999F);
    const float eta = (1 - x) / (1 + x), critical = std::sqrt(1 - eta * eta);
    for (int column = 0; column < columns; ++column)
      for (int row = -rows; row <= rows; ++row) {
        const float r = least + static_cast<float>(column) * (1 - least) / (columns - 1), roughness = r * r;
        const float part = static_cast<float>(std::abs(row)) / rows;
        const float b = 0.5F + roughness - part, root = std::sqrt(b * b + 2 * part * roughness) - b;
        const float cosine = std::clamp(critical + (row < 0 ? -critical : 1 - critical) * root * root, 1e-4F, 1.0F);
        const Ggx<FloatN> ggx{FloatN(roughness * roughness)};
        const Vec3<FloatN> wo(Vec3f{std::sqrt(1 - cosine * cosine), 0, cosine});
        FloatN reflected(0), all(0);
        for (int i = 0; i < facets; i += packet_lanes) {
          const FloatN number = lane_numbers<FloatN>() + FloatN(static_cast<float>(i) + 0.5F);
          const FloatN turn = number * FloatN(0.61803399F), height = number * FloatN(1.0F / facets);
          const Vec3<FloatN> facet =
              ggx.sample_facet(wo, (turn - floor(turn)) * FloatN(0.5F), FloatN(1) - height * height);
          const FloatN met = unshadowed_reflection(ggx, wo, facet) * height;
          const FloatN c = min(max(dot(wo, facet), FloatN(0)), FloatN(1));
          reflected += fresnel_reflection(c, FloatN(eta)).reflectance * met;
          all += met;
        }
        *shares++ = sum_of_lanes(reflected) / sum_of_lanes(all);
      }
  }

  LazyLayers<layers, size> layers_;
};

}  // namespace detail

/// Of facets that reflect as a boundary of that eta does (fresnel.h), below 1: what they reflect over what they would
/// if it was all that they meet, to about half a hundredth. The roughness is the root of alpha.
inline FloatN total_reflection(const FloatN& cosine, const FloatN& roughness, const FloatN& eta) {
  static detail::TotalReflection table;
  return table.look_up(cosine, roughness, eta);
}

}  // namespace raytrace
