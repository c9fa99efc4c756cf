// Sphere and open cylinder.
#include "shapes.h"

namespace reference {

Crossings Sphere::crossings(const Ray& ray) const {
  Crossings result;
  const Real speed = length(ray.direction);
  const Vector direction = 1 / speed * ray.direction;
  const Real to_closest = dot(center_ - ray.origin, direction);
  const Vector closest = ray.origin + to_closest * direction - center_;
  const Real passing = length(closest);
  result.limit_clearance(std::fabs(passing - radius_));
  if (passing > radius_) return result;
  const Real half = std::sqrt((radius_ - passing) * (radius_ + passing));
  result.add((to_closest - half) / speed);
  result.add((to_closest + half) / speed);
  return result;
}

Real Sphere::distance(Vector point) const { return length(point - center_) - radius_; }
Vector Sphere::normal(Vector point) const { return unit(point - center_); }
std::string Sphere::parameters() const { return vector_element("center", center_) + number_element("radius", radius_); }

Cylinder::Cylinder(Vector bottom, Vector top, Real radius)
    : bottom_(bottom), top_(top), axis_(unit(top - bottom)), radius_(radius), height_(length(top - bottom)) {}

Crossings Cylinder::crossings(const Ray& ray) const {
  Crossings result;
  const Real speed = length(ray.direction);
  const Vector direction = 1 / speed * ray.direction;
  const Vector from_bottom = ray.origin - bottom_;
  const Vector across = direction - dot(direction, axis_) * axis_;  // what the direction is in the cross-section
  const Vector start = from_bottom - dot(from_bottom, axis_) * axis_;
  const Real across_squared = dot(across, across);
  if (across_squared == 0) {
    result.limit_clearance(0);
    return result;
  }
  const Real to_closest = -dot(start, across) / across_squared;
  const Real passing = length(start + to_closest * across);
  result.limit_clearance(std::fabs(passing - radius_));
  if (passing > radius_) return result;
  const Real half = std::sqrt((radius_ - passing) * (radius_ + passing) / across_squared);
  for (const Real t : {to_closest - half, to_closest + half}) {
    const Vector point = from_bottom + t * direction;
    const Real height = dot(point, axis_);
    const Real cosine = std::fabs(dot(unit(start + t * across), direction));
    result.limit_clearance(std::fabs(height) * cosine);
    result.limit_clearance(std::fabs(height - height_) * cosine);
    if (height >= 0 && height <= height_) result.add(t / speed);
  }
  return result;
}

Real Cylinder::distance(Vector point) const {
  const Vector from_bottom = point - bottom_;
  return length(from_bottom - dot(from_bottom, axis_) * axis_) - radius_;
}

Vector Cylinder::normal(Vector point) const {
  const Vector from_bottom = point - bottom_;
  return unit(from_bottom - dot(from_bottom, axis_) * axis_);
}

std::string Cylinder::parameters() const {
  return vector_element("bottom", bottom_) + vector_element("top", top_) + number_element("radius", radius_);
}

}  // namespace reference
