// Shapes under transforms, and a mesh.
#pragma once

#include "random.h"
#include "scene.h"

namespace reference {

/// A map of points: scaled along the axes, turned about an axis through a center, which stays, and moved.
struct Transform {
  Vector center;
  Vector scale{1, 1, 1};
  Vector axis{0, 1, 0};
  Real degrees = 0;
  Vector move;

  Vector point(Vector p) const { return center + vector(p - center) + move; }
  Vector vector(Vector v) const;
  Vector inverse_point(Vector p) const { return center + inverse_vector(p - move - center); }
  Vector inverse_vector(Vector v) const;
  /// Of a normal, by the transpose of the inverse; of unit length.
  Vector normal(Vector n) const;
  Real smallest_scale() const;
  Real largest_scale() const;
  std::string element() const;
};

/// A shape under a transform: in the scene format its element with a <transform>, or, where there is a group of that
/// name in which it stands alone, an instance of that.
class Transformed : public Shape {
 public:
  Transformed(ShapePointer shape, const Transform& transform, std::string group = {})
      : shape_(std::move(shape)), transform_(transform), group_(std::move(group)) {}
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override { return shape_->distance(transform_.inverse_point(point)); }
  Vector normal(Vector point) const override {
    return transform_.normal(shape_->normal(transform_.inverse_point(point)));
  }
  Real smallest_extent() const override { return shape_->smallest_extent() * transform_.smallest_scale(); }
  Real largest_extent() const override { return shape_->largest_extent() * transform_.largest_scale(); }
  std::string element() const override { return group_.empty() ? shape_->element() : "instance"; }
  std::string group() const override { return group_.empty() ? shape_->group() : "instances"; }
  std::string parameters() const override;

 private:
  ShapePointer shape_;
  Transform transform_;
  std::string group_;
};

/// A closed mesh of eight flat triangles around a center.
class Octahedron : public Shape {
 public:
  Octahedron(Vector center, Real radius) : center_(center), radius_(radius) {}
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override;
  Vector normal(Vector point) const override;
  Real smallest_extent() const override { return radius_; }
  Real largest_extent() const override { return radius_; }
  std::string element() const override { return "mesh"; }
  std::string group() const override { return "meshes"; }
  std::string parameters() const override;

 private:
  /// Corner i: along +x, -x, +y, -y, +z, -z.
  Vector corner(int i) const;

  Vector center_;
  Real radius_;
};

Transform random_transform(Random& random, Vector center, Real size);

/// Puts most of the scene's objects under transforms, mirrored and stretched ones among them, some of them as instances
/// of groups, after making some of them meshes.
void transform_objects(Scene& scene, unsigned seed);

}  // namespace reference
