// Any number of spheres from a file of points, which are one object.
//
//   <spherecloud> <file>atoms.ply</file> <radius>0.1</radius> <material>red</material> </spherecloud>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

struct PointCloud;

class SphereCloud {
 public:
  struct Parameters {
    FileName file;      ///< .ply, perhaps with .gz behind (import/read_mesh.h)
    double radius = 0;  ///< of all spheres, where the file has none; 0: it has
  };
  using Data = PointCloud;  ///< of the file
  static constexpr std::string_view group = "sphereclouds";
  static constexpr std::string_view element = "spherecloud";
  static constexpr bool may_lack_material = true;  ///< then it has the colours of its file
  static Fields fields() {
    return {required("file", &Parameters::file), optional("radius", &Parameters::radius, Range::not_negative)};
  }
};

}  // namespace raytrace
