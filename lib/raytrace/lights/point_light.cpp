#include "raytrace/lights/point_light.h"

namespace raytrace {

Fields<PointLight::Parameters> PointLight::fields() {
  return {required("location", &Parameters::location), optional("scaleradiance", &Parameters::scaleradiance),
          optional("color", &Parameters::color), optional("shadows", &Parameters::shadows)};
}

}  // namespace raytrace
