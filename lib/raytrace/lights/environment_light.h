// Environment light: radiance from all directions, of infinitely far (Suffern, chapter 18), the same from everywhere,
// less from below, or as a picture has it.
//
//   <environmentlight>
//     <file>sky.exr</file> <scaleradiance>1</scaleradiance> <color red="1" green="1" blue="1"/> <visible>true</visible>
//     <transform> <rotate x="0" y="1" z="0" angle="90"/> </transform>
//   </environmentlight>
//
// The picture is one of longitudes and latitudes, as OpenEXR has it: its middle is +z, -x is a quarter of its width to
// the right of it, and its upper edge is +y. The sphericalcamera that looks at +z makes such pictures.
#pragma once

#include "raytrace/parameters/light_group.h"

namespace raytrace {

class EnvironmentLight {
 public:
  struct Parameters {
    FileName file;  ///< none: the radiance is the same from everywhere
    double scaleradiance = 1;
    Rgb<double> color{1, 1, 1};
    double ground = 1;    ///< without a file: the radiance from below, over that from above; even with height between
    bool visible = true;  ///< to the camera, in place of the background
    Reference group{};    ///< light_group.h
  };
  static constexpr std::string_view group = "environmentlights";  ///< a scene has one item at most
  static constexpr std::string_view element = "environmentlight";
  static constexpr bool may_be_turned = true;  ///< it has a transform, which turns and mirrors alone
  static Fields fields() {
    return {optional("file", &Parameters::file),       optional("scaleradiance", &Parameters::scaleradiance),
            optional("color", &Parameters::color),     optional("ground", &Parameters::ground, Range::not_negative),
            optional("visible", &Parameters::visible), light_group<Parameters>()};
  }
};

}  // namespace raytrace
