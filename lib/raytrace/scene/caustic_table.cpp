#include "raytrace/scene/caustic_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace raytrace {

namespace {

/// More of them would be aimed at better, but each light is weighed for each.
constexpr std::size_t most_targets = 64;

using FocusingObject = GeometryTable::BoundedObject;

Bounds bounds_of(std::span<const FocusingObject> objects) {
  Bounds all = empty_bounds;
  for (const FocusingObject& object : objects) all = join(all, object.bounds);
  return all;
}

float middle(const FocusingObject& object, int axis) {
  return component(object.bounds.lower, axis) / 2 + component(object.bounds.upper, axis) / 2;
}

/// Cuts the objects into at most `parts` groups of neighbours: f(group).
template <class Function>
void for_each_group(std::span<FocusingObject> objects, std::size_t parts, const Function& f) {
  if (parts == 1 || objects.size() == 1) return f(objects);
  const Bounds all = bounds_of(objects);
  int axis = 0;
  const auto width = [&](int i) { return component(all.upper, i) - component(all.lower, i); };
  for (int i = 1; i < 3; ++i)
    if (width(i) > width(axis)) axis = i;
  const std::size_t half = objects.size() / 2;
  std::nth_element(objects.begin(), objects.begin() + static_cast<std::ptrdiff_t>(half), objects.end(),
                   [&](const FocusingObject& a, const FocusingObject& b) {
                     const float x = middle(a, axis), y = middle(b, axis);
                     return x != y ? x < y : a.object < b.object;
                   });
  for_each_group(objects.first(half), parts / 2, f);
  for_each_group(objects.subspan(half), parts - parts / 2, f);
}

float sum_of(const Rgb<float>& c) { return std::abs(c.red) + std::abs(c.green) + std::abs(c.blue); }

/// About what a target gets: at its center, and at points around it, since a spotlight may miss some of them.
double arriving(const LightSource& light, const CausticTable::Target& target) {
  constexpr std::array<Vec3f, 7> offsets{
      {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  double sum = 0;
  for (const Vec3f& offset : offsets) {
    Ray<FloatN> ray;
    ray.origin = Vec3<FloatN>(target.center + offset * target.radius);
    Rgb<FloatN> radiance;
    light.sample(ray, {FloatN(0.5F), FloatN(0.5F)}, radiance);
    const double here = double{sum_of({radiance.red.get(0), radiance.green.get(0), radiance.blue.get(0)})};
    if (here < 1e30) sum += here;
  }
  return sum / offsets.size();
}

}  // namespace

WeightedChoice::WeightedChoice(std::span<const double> weights) {
  double sum = 0;
  for (const double weight : weights) shares_.push_back(sum += weight);
  for (double& share : shares_) share /= sum;
  // What follows the last that may be chosen never is.
  for (std::size_t i = shares_.size(); i > 0; --i) {
    shares_[i - 1] = 1;
    if (weights[i - 1] != 0) break;
  }
}

WeightedChoice::Choice WeightedChoice::choose(float u) const {
  const auto found = std::upper_bound(shares_.begin(), shares_.end() - 1, double{u});
  const double before = found == shares_.begin() ? 0 : *(found - 1);
  return {static_cast<std::int32_t>(found - shares_.begin()), static_cast<float>(*found - before)};
}

CausticTable::CausticTable(const GeometryTable& geometry, std::span<const std::uint8_t> focusing, const Lights& lights)
    : focusing_(focusing.begin(), focusing.end()), scene_sphere_(geometry.bounding_sphere()) {
  add_targets(geometry, focusing);
  source_count_ = lights.sources.size() + lights.emitters.size() + (lights.environment != nullptr ? 1 : 0);
  if (!empty()) weigh(lights);
}

void CausticTable::add_targets(const GeometryTable& geometry, std::span<const std::uint8_t> focusing) {
  std::vector<FocusingObject> objects = geometry.bounded_objects(focusing);
  if (objects.empty()) return;
  // Spheres of a cloud are one object, which is in one target.
  std::stable_sort(objects.begin(), objects.end(),
                   [](const FocusingObject& a, const FocusingObject& b) { return a.object < b.object; });
  std::size_t kept = 0;
  for (const FocusingObject& object : objects) {
    if (kept > 0 && objects[kept - 1].object == object.object) {
      FocusingObject& whole = objects[kept - 1];
      whole.bounds = join(whole.bounds, object.bounds);
      whole.radius = sphere_around(whole.bounds).radius;
    } else {
      objects[kept++] = object;
    }
  }
  objects.resize(kept);
  for_each_group(std::span(objects), most_targets, [&](std::span<const FocusingObject> group) {
    const BoundingSphere all = sphere_around(bounds_of(group));
    double radius = 0;
    for (const FocusingObject& object : group)
      radius = std::max(radius, length(sphere_around(object.bounds).center - all.center) + object.radius);
    const auto number = static_cast<std::int32_t>(targets_.size());
    // A little larger, so that nothing of them is outside by rounding.
    targets_.push_back({Vec3f(all.center), static_cast<float>(std::min(radius, all.radius) * 1.0002)});
    for (const FocusingObject& object : group) {
      std::vector<std::int32_t>& numbers = object.object < 0 ? target_of_instance_ : target_of_object_;
      const auto at = static_cast<std::size_t>(object.object < 0 ? -1 - object.object : object.object);
      if (numbers.size() <= at) numbers.resize(at + 1, -1);
      numbers[at] = number;
    }
  });
}

void CausticTable::weigh(const Lights& lights) {
  constexpr double pi = std::numbers::pi;
  constexpr double least = 1e-3;  // of what might arrive: nothing that shines is left out
  std::vector<double> sources(source_count_), targets(targets_.size());
  const auto add = [&](std::size_t source, std::size_t target, double power) {
    sources[source] += power;
    targets[target] += power;
  };
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    const Target& target = targets_[t];
    const double disk = pi * double{target.radius} * double{target.radius};
    std::size_t source = 0;
    for (const auto& light : lights.sources) {
      const double most = double{sum_of(light->largest_radiance())};
      const auto location = light->location();
      const double distance = location ? double{length(*location - target.center)} + double{target.radius} : 1.0;
      const double faint = most * least / std::max(1.0, distance * distance);
      add(source++, t, (arriving(*light, target) + faint) * disk);
    }
    for (std::size_t i = 0; i < lights.emitters.size(); ++i) {
      const Vec3d way = Vec3d(target.center) - lights.emitters.location(i);
      const double distance2 = dot(way, way) + double{target.radius} * double{target.radius};
      add(source++, t, lights.emitters.area(i) * double{lights.emitters.radiance(i)} * disk / distance2);
    }
    if (lights.environment != nullptr)
      add(source, t, 4 * pi * double{sum_of(lights.environment->mean_radiance())} * disk);
  }
  // So faint or far that floats have nothing left of them.
  const auto choose = [](std::vector<double>& weights) {
    double sum = 0;
    for (const double weight : weights) sum += weight;
    for (double& weight : weights) weight = sum > 0 ? std::max(weight, sum * 1e-9) : 1;
    return WeightedChoice(weights);
  };
  sources_ = choose(sources);
  target_choice_ = choose(targets);
}

IntN CausticTable::target_of(const GeometryTable& geometry, const Hits& hits, const IntN& material) const {
  const MaskN focuses = hits.hit & float_mask<FloatN>(gather(focusing_.data(), material) != IntN(0));
  if (none(focuses)) return IntN(-1);
  const auto in_table = [](const std::vector<std::int32_t>& numbers, const IntN& at) {
    if (numbers.empty()) return IntN(-1);
    const IntN last(static_cast<std::int32_t>(numbers.size()) - 1);
    const IntN found = gather(numbers.data(), min(at, last));
    return select_lanes(float_mask<FloatN>(at > last), IntN(-1), found);
  };
  const MaskN instanced = hits.hit & float_mask<FloatN>(hits.instance != UintN(0u));
  IntN target = in_table(target_of_object_, select_lanes(hits.hit, geometry.object(hits), IntN(0)));
  if (any(instanced)) {
    const IntN number = same_bits<IntN>(hits.instance & UintN(~InstanceTable::shape_of_world)) - IntN(1);
    target = select_lanes(instanced, in_table(target_of_instance_, max(number, IntN(0))), target);
  }
  return select_lanes(focuses, target, IntN(-1));
}

}  // namespace raytrace
