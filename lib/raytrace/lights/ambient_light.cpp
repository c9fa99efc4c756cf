#include "raytrace/lights/ambient_light.h"

namespace raytrace {

Fields<AmbientLight::Parameters> AmbientLight::fields() {
  return {optional("scaleradiance", &Parameters::scaleradiance), optional("color", &Parameters::color)};
}

}  // namespace raytrace
