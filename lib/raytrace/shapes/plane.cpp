#include "raytrace/shapes/plane.h"

namespace raytrace {

Fields<Plane::Parameters> Plane::fields() {
  return {required("point", &Parameters::point), required("normal", &Parameters::normal, Range::nonzero)};
}

Plane::Record<double> Plane::record(const Parameters& parameters) {
  const Vec3d normal = normalize(parameters.normal);
  return {normal, dot(normal, parameters.point)};
}

}  // namespace raytrace
