#include "raytrace/shapes/cylinder.h"

namespace raytrace {

Fields<Cylinder::Parameters> Cylinder::fields() {
  return {required("bottom", &Parameters::bottom), required("top", &Parameters::top),
          required("radius", &Parameters::radius, Range::positive)};
}

std::optional<ParameterDiagnostic> Cylinder::check(const Parameters& parameters) {
  if (length(parameters.top - parameters.bottom) >= smallest_size) return std::nullopt;
  return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                             "the cylinder's <bottom> and <top> are the same point: it has no length"};
}

Cylinder::Record<double> Cylinder::record(const Parameters& parameters) {
  const Vec3d span = parameters.top - parameters.bottom;
  return {parameters.bottom, normalize(span), length(span), parameters.radius};
}

Bounds Cylinder::bounds(const Record<double>& cylinder) {
  // The box of the two rims: a circle around `axis` reaches radius * sqrt(1 - axis_i^2) along axis i.
  const Vec3d& axis = cylinder.axis;
  const double half_height = cylinder.height / 2;
  const auto reach = [&](double axis_i) {
    return std::abs(axis_i) * half_height + cylinder.radius * std::sqrt(std::max(0.0, 1 - axis_i * axis_i));
  };
  return bounds_around(cylinder.bottom + axis * half_height, {reach(axis.x), reach(axis.y), reach(axis.z)});
}

double Cylinder::bounding_radius(const Record<double>& cylinder) {
  return std::hypot(cylinder.height / 2, cylinder.radius);
}

}  // namespace raytrace
