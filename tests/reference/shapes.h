// The shapes of the scene format, each solved on its own for the whole line that carries a ray. No shape knows of
// another, nothing is accelerated, and nothing is shared with the library under test.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "vector.h"

namespace reference {

/// Where the line of a ray crosses a surface.
struct Crossings {
  int count = 0;
  std::array<Real, 4>
      distances{};  ///< in multiples of the ray's direction, ascending; negative ones lie behind the origin

  /// How far (in world units) the line may be shifted sideways before a crossing appears, disappears or changes its
  /// order, at least: the distance to the nearest silhouette, near or far, of the surface as seen along the line.
  Real clearance = std::numeric_limits<Real>::infinity();

  /// Of all crossings, of which there must be one, the closest to t.
  Real nearest_to(Real t) const {
    Real nearest = distances[0];
    for (unsigned i = 1; i < static_cast<unsigned>(count); ++i) {
      if (std::fabs(distances[i] - t) < std::fabs(nearest - t)) nearest = distances[i];
    }
    return nearest;
  }

  void add(Real t) { distances[static_cast<unsigned>(count++)] = t; }
  void limit_clearance(Real bound) { clearance = std::fmin(clearance, bound); }
};

class Shape {
 public:
  virtual ~Shape() = default;
  virtual Crossings crossings(const Ray& ray) const = 0;

  /// The distance of a point to the surface, with the sign of its side (inside, or behind the normal: negative), to
  /// first order near the surface: the implicit function whose gradient on the surface is the unit normal.
  virtual Real distance(Vector point) const = 0;

  /// The unit normal at a point of the surface; of either side.
  virtual Vector normal(Vector point) const = 0;

  /// The smallest and the largest extent: what "relative to the size" may mean. (A plane has none: 1.)
  virtual Real smallest_extent() const = 0;
  virtual Real largest_extent() const = 0;

  /// The element of the scene format, without its name and material: "sphere" and "<center .../><radius>...".
  virtual std::string element() const = 0;
  virtual std::string group() const = 0;
  virtual std::string parameters() const = 0;
};

class Plane : public Shape {
 public:
  Plane(Vector point, Vector normal);
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override { return 1; }
  Real largest_extent() const override { return 1; }
  std::string element() const override { return "plane"; }
  std::string group() const override { return "planes"; }
  std::string parameters() const override;

 private:
  Vector point_, given_normal_, normal_;
};

class Disk : public Shape {
 public:
  Disk(Vector center, Vector normal, Real radius, Real inner_radius = 0);
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override { return radius_; }
  Real largest_extent() const override { return radius_; }
  std::string element() const override { return "disk"; }
  std::string group() const override { return "disks"; }
  std::string parameters() const override;

 protected:
  Vector center_, given_normal_, normal_;
  Real radius_, inner_radius_;
};

class Annulus : public Disk {
 public:
  using Disk::Disk;
  Real smallest_extent() const override { return radius_ - inner_radius_; }
  std::string element() const override { return "annulus"; }
  std::string group() const override { return "annuli"; }
  std::string parameters() const override;
};

class Box : public Shape {
 public:
  Box(Vector min, Vector max) : min_(min), max_(max) {}
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override;
  Real largest_extent() const override;
  std::string element() const override { return "box"; }
  std::string group() const override { return "boxes"; }
  std::string parameters() const override;

 private:
  Vector min_, max_;
};

class Rectangle : public Shape {
 public:
  Rectangle(Vector corner, Vector edge1, Vector edge2);
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override;
  Real largest_extent() const override { return std::fmax(length(edge1_), length(edge2_)); }
  std::string element() const override { return "rectangle"; }
  std::string group() const override { return "rectangles"; }
  std::string parameters() const override;

 private:
  Vector corner_, edge1_, edge2_, normal_;
};

class Sphere : public Shape {
 public:
  Sphere(Vector center, Real radius) : center_(center), radius_(radius) {}
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override { return radius_; }
  Real largest_extent() const override { return radius_; }
  std::string element() const override { return "sphere"; }
  std::string group() const override { return "spheres"; }
  std::string parameters() const override;

 private:
  Vector center_;
  Real radius_;
};

class Triangle : public Shape {
 public:
  Triangle(Vector a, Vector b, Vector c);
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override;  ///< the smallest altitude
  Real largest_extent() const override;   ///< the longest edge
  std::string element() const override { return "triangle"; }
  std::string group() const override { return "triangles"; }
  std::string parameters() const override;

 private:
  std::array<Vector, 3> vertices_;
  Vector normal_;
};

/// Open: no caps.
class Cylinder : public Shape {
 public:
  Cylinder(Vector bottom, Vector top, Real radius);
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override { return std::fmin(radius_, height_); }
  Real largest_extent() const override { return std::fmax(radius_, height_); }
  std::string element() const override { return "cylinder"; }
  std::string group() const override { return "cylinders"; }
  std::string parameters() const override;

 private:
  Vector bottom_, top_, axis_;
  Real radius_, height_;
};

/// Truncated or not, with caps or without.
class Cone : public Shape {
 public:
  Cone(Vector bottom, Vector top, Real radius, Real top_radius, bool caps);
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override;
  Real largest_extent() const override { return std::fmax(height_, std::fmax(radius_, top_radius_)); }
  std::string element() const override { return "cone"; }
  std::string group() const override { return "cones"; }
  std::string parameters() const override;

 protected:
  Vector bottom_, top_, axis_;
  Real radius_, top_radius_, height_;
  bool caps_;

 private:
  /// In the half plane through the axis and a point: the distance from the axis, the height, and how far it is outside
  /// of the side.
  struct Place {
    Real rho, height, outside;
  };
  Place place(Vector point) const;
  Real radius_at(Real height) const { return radius_ + (top_radius_ - radius_) * height / height_; }
  Vector side_normal(Vector point) const;
};

class CappedCylinder : public Cone {
 public:
  CappedCylinder(Vector bottom, Vector top, Real radius) : Cone(bottom, top, radius, radius, true) {}
  std::string element() const override { return "cylinder"; }
  std::string group() const override { return "cylinders"; }
  std::string parameters() const override;
};

/// The circle of the tube radius, turned about the axis. Where the tube is wider than the swept radius the surface
/// passes through itself, and both its sheets count, as in the quartic equation.
class Torus : public Shape {
 public:
  Torus(Vector center, Vector axis, Real swept_radius, Real tube_radius);
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override { return std::fmin(tube_, swept_); }
  Real largest_extent() const override { return swept_ + tube_; }
  std::string element() const override { return "torus"; }
  std::string group() const override { return "toruses"; }
  std::string parameters() const override;

 private:
  Vector center_, given_axis_, axis_;
  Real swept_, tube_;
};

/// A strand of two points: the hull of two spheres, neither of which is in the other.
class RoundCone : public Shape {
 public:
  /// tip_scale: of the radius, at `b`.
  RoundCone(Vector a, Vector b, Real radius, Real tip_scale);
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override { return radius_; }
  Real largest_extent() const override { return length(b_ - a_) + radius_; }
  std::string element() const override { return "curve"; }
  std::string group() const override { return "curves"; }
  std::string parameters() const override;

 private:
  Vector foot(Vector point, Real& radius) const;

  Vector a_, b_;
  Real radius_, tip_scale_;
};

using ShapePointer = std::shared_ptr<const Shape>;

/// `<name x=".." y=".." z=".."/>` and `<name>..</name>` with digits enough to read back the same double.
std::string vector_element(const std::string& name, Vector v);
std::string number_element(const std::string& name, Real value);
std::string color_element(const std::string& name, Vector rgb);

}  // namespace reference
