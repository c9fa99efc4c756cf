// Round cones by their distance alone, without an equation of the surface: it is convex along a line.
#include <algorithm>
#include <cstdio>

#include "shapes.h"

namespace reference {

RoundCone::RoundCone(Vector a, Vector b, Real radius, Real tip_scale)
    : a_(a), b_(b), radius_(radius), tip_scale_(tip_scale) {}

/// Where the normal through a point starts, on the axis, and the radius there: the sphere about it that is nearest.
Vector RoundCone::foot(Vector point, Real& radius) const {
  const Vector axis = unit(b_ - a_);
  const Real height = dot(point - a_, axis), rho = length(point - a_ - height * axis);
  const Real size = length(b_ - a_), lean = radius_ * (1 - tip_scale_);
  // The distance less the radius is least where a step along the axis brings as much of both.
  const Real slope = lean / std::sqrt((size - lean) * (size + lean));
  const Real at = std::clamp(height - rho * slope, Real(0), size);
  radius = radius_ - lean * at / size;
  return a_ + at * axis;
}

Real RoundCone::distance(Vector point) const {
  Real radius = 0;
  const Vector center = foot(point, radius);
  return length(point - center) - radius;
}

Vector RoundCone::normal(Vector point) const {
  Real radius = 0;
  const Vector out = point - foot(point, radius);
  return length(out) > 0 ? unit(out) : unit(b_ - a_);  // at a tip
}

Crossings RoundCone::crossings(const Ray& ray) const {
  Crossings result;
  const Real speed = length(ray.direction);
  const Vector direction = 1 / speed * ray.direction;
  const Vector middle = 0.5L * (a_ + b_);
  const Real start = dot(middle - ray.origin, direction);
  const auto at = [&](Real t) { return distance(ray.origin + (start + t) * direction); };
  const Real reach = length(b_ - a_) + 2 * radius_ * std::fmax(Real(1), tip_scale_);
  // By the golden section, the least distance of the line.
  constexpr Real share = 0.61803398874989484820L;
  Real low = -reach, high = reach;
  Real first = high - share * (high - low), second = low + share * (high - low);
  Real at_first = at(first), at_second = at(second);
  for (int i = 0; i < 100; ++i) {
    if (at_first < at_second) {
      high = second, second = first, at_second = at_first;
      first = high - share * (high - low), at_first = at(first);
    } else {
      low = first, first = second, at_first = at_second;
      second = low + share * (high - low), at_second = at(second);
    }
  }
  const Real nearest = at_first < at_second ? first : second;
  result.limit_clearance(std::fabs(at(nearest)));
  if (at(nearest) >= 0) return result;
  for (const Real end : {-reach, reach}) {
    Real outside = end, inside = nearest;
    for (int i = 0; i < 90; ++i) {
      const Real half = (outside + inside) / 2;
      (at(half) > 0 ? outside : inside) = half;
    }
    result.add((start + inside) / speed);
  }
  return result;
}

std::string RoundCone::parameters() const {
  char points[300];
  std::snprintf(points, sizeof points, "<points>%.17Lg %.17Lg %.17Lg %.17Lg %.17Lg %.17Lg</points>", a_.x, a_.y, a_.z,
                b_.x, b_.y, b_.z);
  return points + number_element("radius", radius_) + number_element("tipscale", tip_scale_);
}

}  // namespace reference
