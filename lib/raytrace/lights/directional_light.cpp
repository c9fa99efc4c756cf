#include "raytrace/lights/directional_light.h"

namespace raytrace {

Fields<DirectionalLight::Parameters> DirectionalLight::fields() {
  return {required("direction", &Parameters::direction, Range::nonzero),
          optional("scaleradiance", &Parameters::scaleradiance), optional("color", &Parameters::color),
          optional("shadows", &Parameters::shadows)};
}

}  // namespace raytrace
