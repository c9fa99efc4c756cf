// Torus (Suffern, chapter 19.6).
//
//   <torus>
//     <center x="0" y="1" z="0"/> <axis x="0" y="1" z="0"/>
//     <sweptradius>2</sweptradius> <tuberadius>0.5</tuberadius> <material>red</material>
//   </torus>
#pragma once

#include "raytrace/parameters/fields.h"
#include "raytrace/shapes/reach.h"

namespace raytrace {

class Torus {
 public:
  struct Parameters {
    Vec3d center{0, 0, 0};
    Vec3d axis{0, 1, 0};     ///< of symmetry; any length but 0
    double sweptradius = 0;  ///< from the center to the middle of the tube
    double tuberadius = 0;   ///< of the tube; may exceed sweptradius (a spindle torus)
  };
  static constexpr std::string_view group = "toruses";
  static constexpr std::string_view element = "torus";
  static Fields fields() {
    return {optional("center", &Parameters::center, a_point), optional("axis", &Parameters::axis, Range::nonzero),
            required("sweptradius", &Parameters::sweptradius, Range::positive),
            required("tuberadius", &Parameters::tuberadius, Range::positive)};
  }

  static double reach(const Parameters& p, const Vec3d& along) {
    return dot(along, p.center) + reach_of_disk(p.axis, p.sweptradius, along) + p.tuberadius * length(along);
  }
};

}  // namespace raytrace
