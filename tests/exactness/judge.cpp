#include "exactness/judge.h"

#include <limits>
#include <sstream>

namespace raytrace::test {

namespace {

using reference::Real;

/// The largest numbers in the difference of ray and shape.
double reach(const ShapeCase& shape, const ProbeRay& ray) {
  return static_cast<double>(length(shape.center - exact_vector(ray.origin))) + shape.size;
}

std::string text_of(const reference::Crossings& crossings) {
  std::ostringstream text;
  text.precision(9);
  for (int i = 0; i < crossings.count; ++i) text << ' ' << crossings.distances[static_cast<unsigned>(i)];
  text << "; nearest silhouette " << crossings.clearance << " away";
  return text.str();
}

}  // namespace

Expectation::Expectation(const ShapeCase& shape, const ProbeRay& ray, const Exactness& exactness) {
  const reference::Ray exact = exact_ray(ray);
  crossings_ = shape.shape->crossings(exact);
  const double float_error = exactness.float_errors * 0x1p-24 * reach(shape, ray);
  const auto size = static_cast<double>(shape.shape->smallest_extent());
  silhouette_ = static_cast<double>(crossings_.clearance) < exactness.band * size + float_error;
  if (silhouette_) return;
  for (unsigned i = 0; i < static_cast<unsigned>(crossings_.count); ++i) {
    const Real t = crossings_.distances[i];
    const Real slope = std::fabs(dot(shape.shape->normal(exact.at(t)), exact.direction));
    const Real largest = length(exact.origin) + length(shape.center) + std::fabs(t) * length(exact.direction);
    const double double_error = 8 * 0x1p-53 * (static_cast<double>(largest) + shape.size);
    tolerances_[i] = exactness.distance * std::fabs(static_cast<double>(t)) +
                     double_error / static_cast<double>(slope) +
                     float_error * static_cast<double>(shape.length_over_altitude() / slope);
    const auto distance = static_cast<double>(t);
    const double near = static_cast<double>(ray.near), far = static_cast<double>(ray.far);
    if (distance < near - tolerances_[i] || distance > far + tolerances_[i]) continue;
    possible_[i] = true;
    if (distance > near + tolerances_[i] && distance < far - tolerances_[i]) {
      first_ = static_cast<int>(i);
      break;
    }
  }
}

double Expectation::error(double distance) const {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned i = 0; i < 4; ++i) {
    if (!possible_[i]) continue;
    const double error = std::fabs(distance - static_cast<double>(crossings_.distances[i]));
    least = std::fmin(least, error == 0 ? 0 : error / tolerances_[i]);
  }
  return least;
}

void Tally::note_wrong(const ShapeCase& shape, const ProbeRay& ray, const Expectation& expected,
                       const std::string& got) {
  if (!first_wrong.empty()) return;
  first_wrong = got + ", crossings at" + text_of(expected.crossings()) + "\n  " + replay(*shape.shape, ray);
}

void Tally::count(const ShapeCase& shape, const ProbeRay& ray, const Expectation& expected, bool hit,
                  double distance_if_hit) {
  ++rays;
  ++(expected.is_silhouette() ? silhouettes : hit ? hits : misses);
  if (expected.is_silhouette()) return;
  if (!hit && !expected.allows_miss()) {
    ++wrong_misses;
    note_wrong(shape, ray, expected, "missed");
  }
  if (!hit) return;
  const double error = expected.error(distance_if_hit);
  if (std::isinf(error)) {
    ++wrong_hits;
    note_wrong(shape, ray, expected, "hit at " + std::to_string(distance_if_hit));
    return;
  }
  distance.update(error, [&] {
    return std::to_string(distance_if_hit) + " for crossings at" + text_of(expected.crossings()) + "\n  " +
           replay(*shape.shape, ray);
  });
}

void Tally::count(const ShapeCase& shape, const ProbeRay& ray, const Expectation& expected, bool hit) {
  ++rays;
  ++(expected.is_silhouette() ? silhouettes : hit ? hits : misses);
  if (expected.is_silhouette()) return;
  if (!hit && !expected.allows_miss()) {
    ++wrong_misses;
    note_wrong(shape, ray, expected, "not occluded");
  }
  // Without a crossing that may be between near and far there is no finite error.
  if (hit && expected.first() < 0 && std::isinf(expected.error(0))) {
    ++wrong_hits;
    note_wrong(shape, ray, expected, "occluded");
  }
}

}  // namespace raytrace::test
