// Sphere (Suffern, chapter 3).
//
//   <sphere> <center x="0" y="1" z="0"/> <radius>1</radius> <material>red</material> </sphere>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Sphere {
 public:
  struct Parameters {
    Vec3d center{};
    double radius = 0;
  };
  static constexpr std::string_view group = "spheres";
  static constexpr std::string_view element = "sphere";
  static Fields fields() {
    return {required("center", &Parameters::center, a_point), required("radius", &Parameters::radius, Range::positive)};
  }

  static double reach(const Parameters& p, const Vec3d& along) {
    return dot(along, p.center) + p.radius * length(along);
  }
};

}  // namespace raytrace
