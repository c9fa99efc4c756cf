#include "raytrace/scene/many_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>

#include "raytrace/math/gather.h"
#include "raytrace/math/lanes.h"
#include "raytrace/sampling/reservoir.h"

namespace raytrace {

namespace {

/// All about where it shines, and on the mean there.
LightEmission emission_of(const PointSource<float>& source, const Photometry* photometry) {
  const Rgb<float> radiance = abs(source.radiance);
  LightEmission emission{{source.location, source.location}, -source.towards, source.edge_cosine};
  emission.power = radiance.red + radiance.green + radiance.blue;
  if (source.edge_cosine < -1) emission.cosine = -1;
  if (photometry == nullptr) return emission;
  // Of files, all up to the last angle that has light, as if it were the same about the axis.
  const auto columns = static_cast<std::size_t>(photometry->columns);
  const auto row = [&](std::size_t i) { return std::span(photometry->shares).subspan(i * columns, columns); };
  double sum = 0, weights = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < std::size_t{Photometry::rows}; ++i) {
    const double angle = static_cast<double>(i) * std::numbers::pi / (Photometry::rows - 1);
    if (std::any_of(row(i).begin(), row(i).end(), [](float share) { return share > 0; })) last = i + 1;
    if (std::cos(angle) < static_cast<double>(emission.cosine)) break;
    for (const float share : row(i)) sum += static_cast<double>(share) * std::sin(angle);
    weights += std::sin(angle) * static_cast<double>(columns);
  }
  if (weights > 0) emission.power *= static_cast<float>(std::max(sum / weights, 1e-3));
  const double reach = std::min(static_cast<double>(last) / (Photometry::rows - 1), 1.0) * std::numbers::pi;
  emission.cosine = std::max(emission.cosine, static_cast<float>(std::cos(reach)) - 1e-6F);
  return emission;
}

}  // namespace

void ManyLights::add(const PointSource<float>& source, const PhotometricShare& photometry, bool shadows) {
  const LightEmission emission = emission_of(source, photometry.photometry());
  if (!(emission.power > 0)) return;
  emissions_.push_back(emission);
  sources_.push_back(source);
  has_shadow_.push_back(shadows ? 1 : 0);
  const Photometry* const table = photometry.photometry();
  photometry_of_.push_back(-1);
  if (table == nullptr) return;
  // Lamps that are mounted alike share it: then lanes with several of them are looked up together.
  const Vec3f& axis = photometry.axis();
  const auto [found, is_new] = photometry_numbers_.try_emplace(std::tuple(table, axis.x, axis.y, axis.z),
                                                               static_cast<std::int32_t>(photometry_.size()));
  if (is_new) photometry_.push_back(photometry);
  photometry_of_.back() = found->second;
}

void ManyLights::build(LightSampling sampling) {
  if (sampling == LightSampling::tree) leaf_size_ = most_together;
  tree_ = LightTree(emissions_, sampling, LightTree::Reach::cone, leaf_size_);
  emissions_ = {};
  photometry_numbers_ = {};
  if (leaf_size_ == 1) return;
  const auto by_leaves = [&](auto& of_lights) {
    std::remove_reference_t<decltype(of_lights)> result;
    for (const std::uint32_t light : tree_.leaves()) {
      if (light == LightTree::none)
        result.emplace_back();
      else
        result.push_back(of_lights[light]);
    }
    of_lights = std::move(result);
  };
  by_leaves(sources_);
  by_leaves(has_shadow_);
  by_leaves(photometry_of_);
}

FloatN ManyLights::photometric_share(const IntN& light, const Vec3<FloatN>& to_light) const {
  const IntN number = gather(photometry_of_.data(), light);
  FloatN share(1);
  for_each_value(number, float_mask<FloatN>(number >= IntN(0)), [&](std::int32_t one, const MaskN& here) {
    share = select(here, photometry_[static_cast<std::size_t>(one)].towards(to_light), share);
  });
  return share;
}

ManyLights::Leaf ManyLights::choose(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const FloatN& u) const {
  const LightTree::Choice choice = tree_.sample(p, normal, u);
  return {choice.light * IntN(static_cast<std::int32_t>(leaf_size_)), leaf_size_, choice.probability, choice.rest};
}

PointSource<FloatN> ManyLights::source(const IntN& light) const {
  return gather_records<PointSource, FloatN>(sources_.data(), LaneIndices(light));
}

Rgb<FloatN> ManyLights::sample(const IntN& light, const PointSource<FloatN>& source, Ray<FloatN>& shadow_ray) const {
  const LightSample<FloatN> sample = source.sample(shadow_ray.origin);
  shadow_ray.direction = sample.to_light;
  shadow_ray.far = sample.t_max;
  return photometry_.empty() ? sample.radiance : sample.radiance * photometric_share(light, sample.to_light);
}

MaskN ManyLights::has_shadow(const IntN& light) const {
  return float_mask<FloatN>(gather(has_shadow_.data(), light) != IntN(0));
}

MaskN ManyLights::sample(Ray<FloatN>& shadow_rays, const Vec3<FloatN>& normal, const FloatN& u,
                         Rgb<FloatN>& radiance) const {
  const Leaf leaf = choose(shadow_rays.origin, normal, u);
  const MaskN is_anywhere = dot(normal, normal) == FloatN(0);
  Reservoir reservoir(leaf.rest);
  IntN chosen_light = leaf.first;
  FloatN weight(1);
  Vec3<FloatN> direction(Vec3f(0, 0, 1));
  radiance = Rgb<FloatN>(Rgb<float>(0, 0, 0));
  for (std::size_t i = 0; i < leaf.size; ++i) {
    const IntN light = leaf.first + IntN(static_cast<std::int32_t>(i));
    const Rgb<FloatN> arriving = sample(light, source(light), shadow_rays);
    const FloatN cosine = select(is_anywhere, FloatN(1), dot(normal, normalize(shadow_rays.direction)));
    const FloatN its_weight = (abs(arriving.red) + abs(arriving.green) + abs(arriving.blue)) * cosine;
    const MaskN chosen = reservoir.add(its_weight);
    weight = select(chosen, its_weight, weight);
    radiance = select(chosen, arriving, radiance);
    direction = select(chosen, shadow_rays.direction, direction);
    chosen_light = select_lanes(chosen, light, chosen_light);
  }
  shadow_rays.direction = direction;
  shadow_rays.far = FloatN(1);
  const MaskN reached = (leaf.probability > FloatN(0)) & (reservoir.total() > FloatN(0));
  const FloatN over_probability = reservoir.total() / weight / leaf.probability;
  radiance = select(reached, radiance * over_probability, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
  return has_shadow(chosen_light);
}

}  // namespace raytrace
