#include "raytrace/shapes/triangle.h"

#include <algorithm>

namespace raytrace {

Fields<Triangle::Parameters> Triangle::fields() {
  return {required("vertexposition1", &Parameters::vertex1), required("vertexposition2", &Parameters::vertex2),
          required("vertexposition3", &Parameters::vertex3)};
}

std::optional<ParameterDiagnostic> Triangle::check(const Parameters& parameters) {
  // The tracer keeps vertices as floats, so that is where the area must not vanish.
  const Vec3d a(Vec3f(parameters.vertex1)), b(Vec3f(parameters.vertex2)), c(Vec3f(parameters.vertex3));
  const double area = length(cross(b - a, c - a));
  const double collinear = 1e-12 * length(b - a) * length(c - a);
  if (area > collinear && area > smallest_size * smallest_size) return std::nullopt;
  return ParameterDiagnostic{ParameterDiagnostic::Effect::skip,
                             "the triangle is degenerate (its corners lie on a line) and is left out"};
}

Triangle::Record<float> Triangle::record(const Parameters& parameters) {
  return {Vec3f(parameters.vertex1), Vec3f(parameters.vertex2), Vec3f(parameters.vertex3)};
}

Bounds Triangle::bounds(const Record<float>& triangle) {
  const auto& [a, b, c] = triangle;
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

}  // namespace raytrace
