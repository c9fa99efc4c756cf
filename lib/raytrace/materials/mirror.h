// Mirror: perfect reflection (Suffern, chapter 24).
//
//   <mirror> <name>glass</name> <cr red="0.9" green="0.95" blue="1"/> </mirror>
#pragma once

#include "raytrace/materials/reflectance.h"
#include "raytrace/materials/surface_detail.h"

namespace raytrace {

class Mirror {
 public:
  /// T: double, or a batch for lanes with textures of their own.
  template <class T>
  struct Values {
    Rgb<T> cr{};                                      ///< the share of light that is reflected, from all directions
    T opacity = T(1), normalmap = T(1), bump = T(1);  ///< of surface_detail.h
  };
  using Parameters = Values<double>;
  static constexpr std::string_view group = "mirrors";
  static constexpr std::string_view element = "mirror";
  static Fields fields() { return with_surface_detail<Parameters>({required("cr", &Parameters::cr)}); }
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    std::vector<ParameterWarning> warnings;
    warn_of_gain(warnings, is_textured, "cr", parameters.cr);
    return warnings;
  }
  /// As materials/kernels.h has it.
  static bool focuses(const Parameters&, const auto&) { return true; }
};

}  // namespace raytrace
