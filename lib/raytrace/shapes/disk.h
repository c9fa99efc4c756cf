// Flat disk (Suffern, chapter 19.3): the part of a plane within a radius of its center.
//
//   <disk> <center x="0" y="1" z="0"/> <normal x="0" y="1" z="0"/> <radius>0.5</radius> <material>red</material>
//   </disk>
//
// docs/how-to-add-a-type.md walks through this pair of files.
#pragma once

#include "raytrace/parameters/fields.h"
#include "raytrace/shapes/reach.h"

namespace raytrace {

class Disk {
 public:
  struct Parameters {
    Vec3d center{};
    Vec3d normal{};  ///< of any length but 0; either side is shaded
    double radius = 0;
  };
  static constexpr std::string_view group = "disks";
  static constexpr std::string_view element = "disk";
  static Fields fields() {
    return {required("center", &Parameters::center, a_point), required("normal", &Parameters::normal, Range::nonzero),
            required("radius", &Parameters::radius, Range::positive)};
  }
  /// Whether one alone has no inside.
  static bool is_open(const Parameters&) { return true; }

  static double reach(const Parameters& p, const Vec3d& along) {
    return dot(along, p.center) + reach_of_disk(p.normal, p.radius, along);
  }
};

}  // namespace raytrace
