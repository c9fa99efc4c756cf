#include "raytrace/shapes/torus.h"

namespace raytrace {

Fields<Torus::Parameters> Torus::fields() {
  return {optional("center", &Parameters::center), optional("axis", &Parameters::axis, Range::nonzero),
          required("sweptradius", &Parameters::sweptradius, Range::positive),
          required("tuberadius", &Parameters::tuberadius, Range::positive)};
}

Torus::Record<double> Torus::record(const Parameters& parameters) {
  return {parameters.center, normalize(parameters.axis), parameters.sweptradius, parameters.tuberadius};
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
