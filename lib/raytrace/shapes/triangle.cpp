#include "raytrace/shapes/triangle.h"

#include <algorithm>

namespace raytrace {

Fields<Triangle::Parameters> Triangle::fields() {
  return {required("vertexposition1", &Parameters::vertex1), required("vertexposition2", &Parameters::vertex2),
          required("vertexposition3", &Parameters::vertex3)};
}

std::optional<Problem> Triangle::check(const Parameters& parameters) {
  // The tracer keeps vertices as floats, so that is where the area must not vanish.
  const Vec3d a(Vec3f(parameters.vertex1)), b(Vec3f(parameters.vertex2)), c(Vec3f(parameters.vertex3));
  const double area = length(cross(b - a, c - a));
  const double collinear = 1e-12 * length(b - a) * length(c - a);
  if (area > collinear && area > smallest_size * smallest_size) return std::nullopt;
  return Problem{Problem::Kind::skip, "the triangle is degenerate (its corners lie on a line) and is left out"};
}

Triangle::Record<float> Triangle::record(const Parameters& parameters) {
  const Vec3f a(parameters.vertex1), b(parameters.vertex2), c(parameters.vertex3);
  return {a, b, c, Vec3f(normalize(cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a))))};
}

Bounds Triangle::bounds(const Record<float>& triangle) {
  const Vec3d a(triangle.vertex1), b(triangle.vertex2), c(triangle.vertex3);
  const Vec3d lower{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})};
  const Vec3d upper{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
  const Vec3d center = (lower + upper) * 0.5, extent = (upper - lower) * 0.5;
  // A ray through an edge runs along the border of the box. Embree's test of the box is off by some roundings of the
  // coordinates of the box and of the ray's origin: 2^-10 of the size allows for origins 10,000 sizes away.
  const double margin = 0x1p-10 * std::max({extent.x, extent.y, extent.z}) +
                        0x1p-21 * std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
  return bounds_around(center, extent + Vec3d{margin, margin, margin});
}

}  // namespace raytrace
