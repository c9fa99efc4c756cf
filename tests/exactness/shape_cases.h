// Random shapes, and random rays that put them to the test. All numbers are exact in float, so that the library and the
// reference are asked about the very same shape and ray.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "exactness/random.h"
#include "reference/shapes.h"
#include "support/probe.h"

namespace raytrace::test {

/// How often what is random is drawn.
inline constexpr int rays_a_scene = 2000;
inline constexpr int rays_a_shape = 1'000'000;

struct ShapeCase {
  reference::ShapePointer shape;
  reference::Vector center;  ///< somewhere in it
  double size = 1;           ///< its largest extent, or how far from `center` rays should look at a plane
  std::function<reference::Vector(Random&)> point;  ///< a random point of the surface, nearly
  std::function<reference::Vector(Random&)> edge;   ///< of its border; empty: it has none

  /// Large for slivers.
  reference::Real length_over_altitude() const { return shape->largest_extent() / shape->smallest_extent(); }
};

/// What ray and shape tests are about: "plane", "sphere", "triangle", "disk", "rectangle", "cylinder", "torus",
/// "spindle" (a torus that meets itself), "box", "cone", "annulus", "capped cylinder", "capped cone", "strand" (a curve
/// of two points). Positions up to 1e4 from the origin, sizes from 1e-3 to 1e4, drawn apart from each other.
ShapeCase random_shape_case(const std::string& kind, Random& random);

/// Aimed, grazing by 1e-7 to 0.1 of the size on either side, at borders, from inside, from nearby, along the axes of
/// the world and of the shape; from as near as 1e-3 sizes and as far as 1e4; directions 1e-3 to 1e3 long; one in ten
/// with limits near and far.
ProbeRay random_ray(const ShapeCase& shape, Random& random);

reference::Ray exact_ray(const ProbeRay& ray);
reference::Vector exact_vector(const Vec3f& v);
Vec3f rounded(const reference::Vector& v);

/// A scene of these shapes, all of one material.
std::string scene_of(std::span<const reference::ShapePointer> shapes);

/// Shape and ray as they must be typed to see the case again.
std::string replay(const reference::Shape& shape, const ProbeRay& ray);

}  // namespace raytrace::test
