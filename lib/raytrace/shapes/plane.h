// Infinite plane (Suffern, chapter 3).
//
//   <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>floor</material> </plane>
#pragma once

#include "raytrace/math/affine.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class Plane {
 public:
  struct Parameters {
    Vec3d point{};   ///< any point on the plane
    Vec3d normal{};  ///< of any length but 0; either side is shaded
  };
  static constexpr std::string_view group = "planes";
  static constexpr std::string_view element = "plane";
  static Parameters transformed(const Parameters& parameters, const Affine& affine) {
    return {affine.point(parameters.point), affine.normal(parameters.normal)};
  }
  static bool keeps_uv(const Affine& affine) { return affine.is_identity(); }
  static Fields fields() {
    return {required("point", &Parameters::point, a_point), required("normal", &Parameters::normal, Range::nonzero)};
  }
};

}  // namespace raytrace
