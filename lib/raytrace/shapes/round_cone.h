// Round cones: the hulls of two spheres, what pieces of strands are. Solved in double, since they may be long and thin.
//
// One is the union of the spheres and of the frustum between the circles at which it touches them. As it is convex, a
// ray is inside from the first entry of the three to the last exit.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/math/bounds.h"
#include "raytrace/math/inline.h"
#include "raytrace/math/vec3.h"
#include "raytrace/shapes/frustum.h"

namespace raytrace {

struct RoundCone {
  Vec3d start, axis;  ///< the axis of unit length, from the first sphere's center to the second's
  double length, radius, end_radius;
  /// Of how far the side's normals lean towards the end. 0 and 1 where one sphere is in the other: there is no side.
  double sine, cosine;
  bool has_side;
  double first_foot, last_foot;  ///< along the axis, where normals start: at a sphere's center, or between both

  static RoundCone between(const Vec3d& a, double radius, const Vec3d& b, double end_radius) {
    RoundCone cone{a, {0, 0, 1}, raytrace::length(b - a), radius, end_radius, 0, 1, false, 0, 0};
    if (cone.length > 0) cone.axis = (b - a) * (1 / cone.length);
    const double lean = radius - end_radius;
    cone.has_side = std::abs(lean) < cone.length;
    if (cone.has_side) {
      cone.sine = lean / cone.length;
      cone.cosine = std::sqrt((cone.length - lean) * (cone.length + lean)) / cone.length;
      cone.last_foot = cone.length;
    } else if (radius < end_radius) {
      cone.first_foot = cone.last_foot = cone.length;
    }
    return cone;
  }

  Vec3d end() const { return start + axis * length; }
  double widening() const { return length > 0 ? (end_radius - radius) / length : 0; }

  /// Where the normal of the surface next to a point starts, along the axis.
  double foot_of(const Vec3d& p) const {
    const Vec3d from = p - start;
    const double height = dot(from, axis);
    return std::clamp(height - raytrace::length(from - axis * height) * (sine / cosine), first_foot, last_foot);
  }

  /// Whether points are in it, and not on its surface, as rounding has it.
  template <class D>
  RAYTRACE_INLINE auto contains(const Vec3<D>& p) const {
    const Vec3<D> from = p - Vec3<D>(start), n(axis);
    const D height = dot(from, n);
    const Vec3<D> across = from - n * height;
    const D across2 = dot(across, across);
    const D foot = min(max(height - sqrt(across2) * D(sine / cosine), D(first_foot)), D(last_foot)),
            above = height - foot;
    const D r = multiply_add(D(widening()), foot, D(radius)) * D(1 - 1e-6);
    return multiply_add(above, above, across2) < r * r;
  }

  Bounds bounds() const {
    return join(bounds_around(start, {radius, radius, radius}),
                bounds_around(end(), {end_radius, end_radius, end_radius}));
  }
};

/// From where rays come into a round cone to where they leave it.
template <class D>
struct RoundConeStretch {
  using DoubleMask = decltype(D(0.0) < D(0.0));

  D entry, exit;  ///< nowhere if entry <= exit is false
  // Whether they are on its first sphere, and on nothing else.
  DoubleMask enters_start, leaves_start;

  RAYTRACE_INLINE RoundConeStretch(const RoundCone& cone, const Vec3<D>& origin, const Vec3<D>& direction) {
    const double bottom = cone.radius * cone.sine;  // of the side, along the axis
    const FrustumRay<D> side(
        {Vec3<D>(cone.start + cone.axis * bottom), Vec3<D>(cone.axis), D(cone.length * cone.cosine * cone.cosine),
         D(cone.radius * cone.cosine), D(-cone.sine / cone.cosine), D(1.0)},
        origin, direction);
    const D infinite(std::numeric_limits<double>::infinity());
    const auto speed2 = dot(direction, direction);
    const auto sphere = [&](double center, double radius) RAYTRACE_INLINE_LAMBDA {
      const Vec3<D> from = side.across + side.frustum.axis * (side.height - D(center));
      const Vec3<D> passing = cross(from, direction);
      const D square = D(radius * radius) * speed2 - dot(passing, passing), root = sqrt(max(square, D(0.0)));
      const D middle = -dot(from, direction);
      const auto misses = square < D(0.0);
      return typename FrustumRay<D>::Stretch{select(misses, infinite, (middle - root) / speed2),
                                             select(misses, -infinite, (middle + root) / speed2)};
    };
    const auto first = sphere(-bottom, cone.radius), second = sphere(cone.length - bottom, cone.end_radius);
    D others_entry = second.entry, others_exit = second.exit;
    if (cone.has_side) {
      const auto inside = side.inside();
      const auto meets = inside.entry <= inside.exit;
      others_entry = select(meets, min(others_entry, inside.entry), others_entry);
      others_exit = select(meets, max(others_exit, inside.exit), others_exit);
    }
    enters_start = first.entry < others_entry;
    leaves_start = first.exit > others_exit;
    entry = side.start + min(first.entry, others_entry);
    exit = side.start + max(first.exit, others_exit);
  }
};

/// Whether rays, in their whole length, may meet it: false for most that its box lets through.
template <class D>
RAYTRACE_INLINE auto passes_near(const RoundCone& cone, const Vec3<D>& origin, const Vec3<D>& direction) {
  const Vec3<D> normal = cross(direction, Vec3<D>(cone.axis));
  const D distance = dot(origin - Vec3<D>(cone.start), normal);
  const double most = std::max(cone.radius, cone.end_radius) * (1 + 1e-6);
  const D square = dot(normal, normal);
  // Along the axis the cross product is rounding alone.
  return (distance * distance <= D(most * most) * square) | (square < D(1e-10) * dot(direction, direction));
}

}  // namespace raytrace
