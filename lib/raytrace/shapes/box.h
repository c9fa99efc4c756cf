// Box along the axes of the world, between two opposite corners (Suffern, chapter 19.4).
//
//   <box> <min x="-1" y="0" z="-1"/> <max x="1" y="2" z="1"/> <material>red</material> </box>
#pragma once

#include <algorithm>

#include "raytrace/math/affine.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class Box {
 public:
  struct Parameters {
    Vec3d min{}, max{};  ///< min is the smaller along each axis
  };
  static constexpr std::string_view group = "boxes";
  static constexpr std::string_view element = "box";
  static Fields fields() {
    return {required("min", &Parameters::min, a_point), required("max", &Parameters::max, a_point)};
  }

  /// As long as its edges stay along the axes.
  static std::optional<Parameters> transformed(const Parameters& parameters, const Affine& affine) {
    for (const Vec3d& axis : {affine.x, affine.y, affine.z})
      if ((axis.x != 0) + (axis.y != 0) + (axis.z != 0) != 1) return std::nullopt;
    const Vec3d a = affine.point(parameters.min), b = affine.point(parameters.max);
    return Parameters{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                      {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
  }

  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const Vec3d size = parameters.max - parameters.min;
    const char* const flat = size.x < smallest_size   ? "x"
                             : size.y < smallest_size ? "y"
                             : size.z < smallest_size ? "z"
                                                      : nullptr;
    if (flat == nullptr) return std::nullopt;
    return ParameterDiagnostic{
        ParameterDiagnostic::Effect::error,
        std::string("the box's <min> is not less than its <max> along ") + flat + ": it has no volume"};
  }

  static double reach(const Parameters& p, const Vec3d& along) {
    return std::max(along.x * p.min.x, along.x * p.max.x) + std::max(along.y * p.min.y, along.y * p.max.y) +
           std::max(along.z * p.min.z, along.z * p.max.z);
  }
};

}  // namespace raytrace
