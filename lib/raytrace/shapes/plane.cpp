#include "raytrace/shapes/plane.h"

namespace raytrace {

Fields<Plane::Parameters> Plane::fields() {
  return {required("point", &Parameters::point), required("normal", &Parameters::normal, Range::nonzero)};
}

Plane::Record Plane::record(const Parameters& parameters) {
  Record plane{};
  plane.normal = normalize(parameters.normal);
  plane.offset = dot(plane.normal, parameters.point);
  const Vec3d& normal = plane.normal;
  plane.axis = normal.y == 0 && normal.z == 0   ? 0
               : normal.x == 0 && normal.z == 0 ? 1
               : normal.x == 0 && normal.y == 0 ? 2
                                                : 3;
  if (plane.axis < 3) {
    const double place = plane.offset * component(normal, plane.axis);
    plane.place = static_cast<float>(place);
    plane.rest = static_cast<float>(place - double{plane.place});
  }
  return plane;
}

}  // namespace raytrace
