// Emissive: a surface that shines by itself, and reflects nothing.
//
//   <emissive> <name>lamp</name> <ce red="1" green="0.9" blue="0.7"/> <scaleradiance>10</scaleradiance> </emissive>
//
// It shines from its front: the side from which a triangle's vertices run counter-clockwise, the outside of a closed
// shape, the side of a plane's or a disk's normal.
#pragma once

#include "raytrace/materials/surface_detail.h"
#include "raytrace/parameters/light_group.h"

namespace raytrace {

class Emissive {
 public:
  /// T: double, or a batch for lanes with textures of their own.
  template <class T>
  struct Values {
    Rgb<T> ce{};                                      ///< colour
    T scaleradiance = T(1);                           ///< the radiance is ce times it
    T opacity = T(1), normalmap = T(1), bump = T(1);  ///< of surface_detail.h
  };
  struct Parameters : Values<double> {
    bool twosided = false;  ///< its back shines, too
    Reference group{};      ///< light_group.h
  };
  static constexpr std::string_view group = "emissives";
  static constexpr std::string_view element = "emissive";
  static Fields fields() {
    return with_surface_detail<Parameters>({required("ce", &Parameters::ce),
                                            optional("scaleradiance", &Parameters::scaleradiance, Range::not_negative),
                                            optional("twosided", &Parameters::twosided), light_group<Parameters>()});
  }
  static bool is_two_sided(const Parameters& parameters) { return parameters.twosided; }
};

}  // namespace raytrace
