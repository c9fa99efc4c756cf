#include "raytrace/shapes/disk.h"

namespace raytrace {

Fields<Disk::Parameters> Disk::fields() {
  return {required("center", &Parameters::center), required("normal", &Parameters::normal, Range::nonzero),
          required("radius", &Parameters::radius, Range::positive)};
}

Disk::Record<double> Disk::record(const Parameters& parameters) {
  return {parameters.center, normalize(parameters.normal), parameters.radius};
}

Bounds Disk::bounds(const Record<double>& disk) {
  // A circle across `normal` reaches radius * sqrt(1 - normal_i^2) along axis i.
  const auto reach = [&](double normal_i) { return disk.radius * std::sqrt(std::max(0.0, 1 - normal_i * normal_i)); };
  return bounds_around(disk.center, {reach(disk.normal.x), reach(disk.normal.y), reach(disk.normal.z)});
}

double Disk::bounding_radius(const Record<double>& disk) { return disk.radius; }

}  // namespace raytrace
