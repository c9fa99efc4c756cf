// The torus: a quartic, its roots isolated between those of its derivatives and then closed in on by bisection.
#include <algorithm>
#include <utility>

#include "shapes.h"

namespace reference {

namespace {

/// A few ascending numbers.
struct Roots {
  int count = 0;
  std::array<Real, 4> values{};
  void add(Real x) { values[static_cast<unsigned>(count++)] = x; }
};

/// The root of f in [low, high], at whose ends f has opposite signs: Newton's steps, bisection where they leave the
/// bracket.
template <class Function, class Derivative>
Real bracketed_root(const Function& f, const Derivative& derivative, Real low, Real high) {
  const bool rises = f(low) < 0;
  Real x = (low + high) / 2;
  for (int step = 0; step < 200; ++step) {
    const Real value = f(x);
    if (value == 0) return x;
    ((value < 0) == rises ? low : high) = x;
    const Real slope = derivative(x);
    Real next = slope != 0 ? x - value / slope : low;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == x || next == low || next == high) return next;
    // Newton's steps may crawl on one side of a root that is nearly double: every fourth step halves the bracket.
    if (step % 4 == 3) next = (low + high) / 2;
    x = next;
  }
  return x;
}

/// The roots of f where it changes its sign in [low, high], given all of its extrema in ascending order.
template <class Function, class Derivative>
Roots roots_between(const Function& f, const Derivative& derivative, const Roots& extrema, Real low, Real high) {
  Roots result;
  Real from = low;
  for (int i = 0; i <= extrema.count; ++i) {
    const Real to = i < extrema.count ? std::clamp(extrema.values[static_cast<unsigned>(i)], low, high) : high;
    if (to > from && (f(from) < 0) != (f(to) < 0)) result.add(bracketed_root(f, derivative, from, to));
    from = to;
  }
  return result;
}

}  // namespace

Torus::Torus(Vector center, Vector axis, Real swept_radius, Real tube_radius)
    : center_(center), given_axis_(axis), axis_(unit(axis)), swept_(swept_radius), tube_(tube_radius) {}

Crossings Torus::crossings(const Ray& ray) const {
  Crossings result;
  // Distances s count from the point of the line that is closest to the centre, in swept radii.
  const Real speed = length(ray.direction);
  const Vector direction = 1 / speed * ray.direction;
  const Real to_closest = dot(center_ - ray.origin, direction);
  const Vector closest = 1 / swept_ * (ray.origin + to_closest * direction - center_);
  const Real r = tube_ / swept_;
  const Real passing = length(closest);
  const Real outer = 1 + r;
  if (passing > outer) {
    // Outside the sphere around it: the torus may be farther still.
    result.limit_clearance((passing - outer) * swept_);
    return result;
  }

  // With m = |closest|^2 and y = py + s dy the height over the torus's plane, a point of the line is on the surface
  // where (s^2 + m + 1 - r^2)^2 = 4 (s^2 + m - y^2). There is no s^3 and, since closest is at right angles to
  // direction, no m s.
  const Real py = dot(closest, axis_), dy = dot(direction, axis_);
  const Real m = passing * passing;
  const Real k = m + (1 - r) * (1 + r);
  const Real c2 = 2 * k - 4 * (1 - dy) * (1 + dy);
  const Real c1 = 8 * py * dy;
  const Real c0 = k * k - 4 * (m - py * py);
  const auto quartic = [&](Real s) { return ((s * s + c2) * s + c1) * s + c0; };
  const auto first = [&](Real s) { return (4 * s * s + 2 * c2) * s + c1; };
  const auto second = [&](Real s) { return 12 * s * s + 2 * c2; };

  const Real reach = std::sqrt((outer - passing) * (outer + passing)) + 1e-3L;  // beyond: outside of the torus
  Roots bends;                                                                  // of the first derivative
  if (c2 < 0) {
    bends.add(-std::sqrt(-c2 / 6));
    bends.add(std::sqrt(-c2 / 6));
  }
  const Roots extrema = roots_between(first, second, bends, -reach - 4, reach + 4);
  const Roots roots = roots_between(quartic, first, extrema, -reach, reach);

  for (int i = 0; i < extrema.count; ++i) {
    const Real s = extrema.values[static_cast<unsigned>(i)];
    result.limit_clearance(std::fabs(distance(center_ + swept_ * (closest + s * direction))));
  }
  for (int i = 0; i < roots.count; ++i) {
    result.add((to_closest + roots.values[static_cast<unsigned>(i)] * swept_) / speed);
  }
  return result;
}

Real Torus::distance(Vector point) const {
  const Vector p = point - center_;
  const Real y = dot(p, axis_);
  const Real rho = length(p - y * axis_);
  const Real outer = std::hypot(rho - swept_, y) - tube_;
  const Real inner = std::hypot(rho + swept_, y) - tube_;  // the sheet about the axis, of a torus that meets itself
  return std::fabs(inner) < std::fabs(outer) ? inner : outer;
}

Vector Torus::normal(Vector point) const {
  const Vector p = point - center_;
  const Real y = dot(p, axis_);
  const Vector across = p - y * axis_;
  const Real rho = length(across);
  const bool inner = std::fabs(std::hypot(rho + swept_, y) - tube_) < std::fabs(std::hypot(rho - swept_, y) - tube_);
  const Vector outwards = 1 / rho * across;
  return unit((inner ? rho + swept_ : rho - swept_) * outwards + y * axis_);
}

std::string Torus::parameters() const {
  return vector_element("center", center_) + vector_element("axis", given_axis_) +
         number_element("sweptradius", swept_) + number_element("tuberadius", tube_);
}

}  // namespace reference
