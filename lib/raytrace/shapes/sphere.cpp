#include "raytrace/shapes/sphere.h"

namespace raytrace {

Fields<Sphere::Parameters> Sphere::fields() {
  return {required("center", &Parameters::center), required("radius", &Parameters::radius, Range::positive)};
}

Sphere::Record<float> Sphere::record(const Parameters& parameters) {
  return {Vec3f(parameters.center), static_cast<float>(parameters.radius)};
}

Bounds Sphere::bounds(const Record<float>& sphere) {
  const double r = sphere.radius;
  return bounds_around(Vec3d(sphere.center), {r, r, r});
}

double Sphere::bounding_radius(const Record<float>& sphere) { return sphere.radius; }

}  // namespace raytrace
