#include "raytrace/shapes/torus.h"

namespace raytrace {

Fields<Torus::Parameters> Torus::fields() {
  return {optional("center", &Parameters::center), optional("axis", &Parameters::axis, Range::nonzero),
          required("sweptradius", &Parameters::sweptradius, Range::positive),
          required("tuberadius", &Parameters::tuberadius, Range::positive)};
}

Torus::Record<double> Torus::record(const Parameters& parameters) {
  const Vec3d axis = normalize(parameters.axis);
  // The unit vector least along the axis gives the most precise perpendicular.
  const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
  const Vec3d least = x <= y && x <= z ? Vec3d{1, 0, 0} : y <= z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  const Vec3d side1 = normalize(cross(axis, least));
  return {parameters.center, side1, axis, cross(side1, axis), parameters.sweptradius, parameters.tuberadius};
}

Bounds Torus::bounds(const Record<double>& torus) {
  // A circle around `axis` reaches swept * sqrt(1 - axis_i^2) along axis i, and the tube its radius further.
  const auto reach = [&](double axis_i) {
    return torus.swept * std::sqrt(std::max(0.0, 1 - axis_i * axis_i)) + torus.tube;
  };
  return bounds_around(torus.center, {reach(torus.axis.x), reach(torus.axis.y), reach(torus.axis.z)});
}

double Torus::bounding_radius(const Record<double>& torus) { return torus.swept + torus.tube; }

}  // namespace raytrace
