// Ambient occlusion, for looking at a model: how much of a white sky each surface sees (Suffern, chapter 17). Each
// sample looks into one direction, the more likely the nearer it is to the normal: white if nothing is there, else
// black. Without lights and materials.
//
//   <integrator> <ambientocclusion> <distance>2</distance> </ambientocclusion> </integrator>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class AmbientOcclusion {
 public:
  struct Parameters {
    double distance = 0;  ///< what lies farther away hides nothing; 0: there is no such distance
  };
  static constexpr std::string_view element = "ambientocclusion";
  static Fields fields() { return {optional("distance", &Parameters::distance, Range::not_negative)}; }
};

}  // namespace raytrace
