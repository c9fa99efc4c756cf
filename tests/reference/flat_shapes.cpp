// Plane, disk, annulus, rectangle, triangle, box.
#include <algorithm>

#include "shapes.h"

namespace reference {

namespace {

/// Where the line meets the plane through `point`; NaN where it is parallel to it.
Real plane_distance(const Ray& ray, Vector point, Vector normal) {
  const Real slope = dot(ray.direction, normal);
  return slope == 0 ? std::numeric_limits<Real>::quiet_NaN() : dot(point - ray.origin, normal) / slope;
}

/// The distance between a line (direction of unit length) and a segment.
Real line_to_segment(Vector origin, Vector direction, Vector a, Vector b) {
  // Seen along the line, the segment is one in a plane and the line is a point: drop the component along the line.
  const auto flatten = [&](Vector v) { return v - dot(v, direction) * direction; };
  const Vector start = flatten(a - origin);
  const Vector edge = flatten(b - origin) - start;
  const Real squared = dot(edge, edge);
  const Real s = squared > 0 ? std::clamp(-dot(start, edge) / squared, Real(0), Real(1)) : 0;
  return length(start + s * edge);
}

}  // namespace

Plane::Plane(Vector point, Vector normal) : point_(point), given_normal_(normal), normal_(unit(normal)) {}

Crossings Plane::crossings(const Ray& ray) const {
  Crossings result;
  const Real t = plane_distance(ray, point_, normal_);
  if (std::isfinite(t)) result.add(t);
  return result;
}

Real Plane::distance(Vector point) const { return dot(point - point_, normal_); }
Vector Plane::normal(Vector) const { return normal_; }
std::string Plane::parameters() const {
  return vector_element("point", point_) + vector_element("normal", given_normal_);
}

Disk::Disk(Vector center, Vector normal, Real radius, Real inner_radius)
    : center_(center), given_normal_(normal), normal_(unit(normal)), radius_(radius), inner_radius_(inner_radius) {}

Crossings Disk::crossings(const Ray& ray) const {
  Crossings result;
  const Real t = plane_distance(ray, center_, normal_);
  if (!std::isfinite(t)) {
    result.limit_clearance(0);
    return result;
  }
  const Real from_center = length(ray.at(t) - center_);
  if (from_center <= radius_ && from_center >= inner_radius_) result.add(t);
  const Real cosine = std::fabs(dot(ray.direction, normal_)) / length(ray.direction);
  result.limit_clearance(std::fabs(from_center - radius_) * cosine);
  if (inner_radius_ > 0) result.limit_clearance(std::fabs(from_center - inner_radius_) * cosine);
  return result;
}

Real Disk::distance(Vector point) const { return dot(point - center_, normal_); }
Vector Disk::normal(Vector) const { return normal_; }
std::string Disk::parameters() const {
  return vector_element("center", center_) + vector_element("normal", given_normal_) +
         number_element("radius", radius_);
}

std::string Annulus::parameters() const {
  return vector_element("center", center_) + vector_element("normal", given_normal_) +
         number_element("innerradius", inner_radius_) + number_element("outerradius", radius_);
}

Rectangle::Rectangle(Vector corner, Vector edge1, Vector edge2)
    : corner_(corner), edge1_(edge1), edge2_(edge2), normal_(unit(cross(edge1, edge2))) {}

Crossings Rectangle::crossings(const Ray& ray) const {
  Crossings result;
  const Vector direction = unit(ray.direction);
  const Vector corners[] = {corner_, corner_ + edge1_, corner_ + edge1_ + edge2_, corner_ + edge2_};
  int left = 0, right = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const Vector a = corners[i], b = corners[(i + 1) % 4];
    const Real volume = dot(direction, cross(a - ray.origin, b - ray.origin));
    left += volume >= 0;
    right += volume <= 0;
    result.limit_clearance(line_to_segment(ray.origin, direction, a, b));
  }
  const Real t = plane_distance(ray, corner_, normal_);
  if ((left == 4 || right == 4) && std::isfinite(t)) result.add(t);
  return result;
}

Real Rectangle::distance(Vector point) const { return dot(point - corner_, normal_); }
Vector Rectangle::normal(Vector) const { return normal_; }
Real Rectangle::smallest_extent() const { return length(cross(edge1_, edge2_)) / largest_extent(); }
std::string Rectangle::parameters() const {
  return vector_element("corner", corner_) + vector_element("edge1", edge1_) + vector_element("edge2", edge2_);
}

Triangle::Triangle(Vector a, Vector b, Vector c) : vertices_{a, b, c}, normal_(unit(cross(b - a, c - a))) {}

Crossings Triangle::crossings(const Ray& ray) const {
  Crossings result;
  const Vector direction = unit(ray.direction);
  int left = 0, right = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const Vector a = vertices_[i], b = vertices_[(i + 1) % 3];
    const Real volume = dot(direction, cross(a - ray.origin, b - ray.origin));
    left += volume >= 0;
    right += volume <= 0;
    result.limit_clearance(line_to_segment(ray.origin, direction, a, b));
  }
  const Real t = plane_distance(ray, vertices_[0], normal_);
  if ((left == 3 || right == 3) && std::isfinite(t)) result.add(t);
  return result;
}

Real Triangle::distance(Vector point) const { return dot(point - vertices_[0], normal_); }
Vector Triangle::normal(Vector) const { return normal_; }

Real Triangle::largest_extent() const {
  Real longest = 0;
  for (unsigned i = 0; i < 3; ++i) longest = std::fmax(longest, length(vertices_[(i + 1) % 3] - vertices_[i]));
  return longest;
}

Real Triangle::smallest_extent() const {
  return length(cross(vertices_[1] - vertices_[0], vertices_[2] - vertices_[0])) / largest_extent();
}

std::string Triangle::parameters() const {
  return vector_element("vertexposition1", vertices_[0]) + vector_element("vertexposition2", vertices_[1]) +
         vector_element("vertexposition3", vertices_[2]);
}

Crossings Box::crossings(const Ray& ray) const {
  // Six rectangles, of which a line through the box crosses two.
  Crossings result;
  const Vector size = max_ - min_;
  const Vector x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  for (const Rectangle& face : {Rectangle(min_, x, y), Rectangle(min_, y, z), Rectangle(min_, z, x),
                                Rectangle(max_, -x, -y), Rectangle(max_, -y, -z), Rectangle(max_, -z, -x)}) {
    const Crossings crossing = face.crossings(ray);
    result.limit_clearance(crossing.clearance);
    if (crossing.count > 0 && result.count < 2) result.add(crossing.distances[0]);
  }
  if (result.count == 2 && result.distances[0] > result.distances[1])
    std::swap(result.distances[0], result.distances[1]);
  return result;
}

Real Box::distance(Vector point) const {
  const Vector below = min_ - point, above = point - max_;
  return std::max({below.x, below.y, below.z, above.x, above.y, above.z});
}

Vector Box::normal(Vector point) const {
  const Real outside = distance(point);
  const Vector below = min_ - point, above = point - max_;
  const auto along = [&](Real low, Real high) { return Real(high >= outside) - Real(low >= outside); };
  const Vector all{along(below.x, above.x), along(below.y, above.y), along(below.z, above.z)};
  return all.x != 0 ? Vector{all.x, 0, 0} : all.y != 0 ? Vector{0, all.y, 0} : Vector{0, 0, all.z};
}

Real Box::smallest_extent() const {
  const Vector size = max_ - min_;
  return std::min({size.x, size.y, size.z});
}

Real Box::largest_extent() const {
  const Vector size = max_ - min_;
  return std::max({size.x, size.y, size.z});
}

std::string Box::parameters() const { return vector_element("min", min_) + vector_element("max", max_); }

}  // namespace reference
