// What a skylight's sun sends to a point. Its sky is an environment (scene/environment.h).
#pragma once

#include "raytrace/lights/directional_light_kernel.h"
#include "raytrace/lights/sky_model.h"

namespace raytrace {

template <>
class Kernel<SkyLight> : public Kernel<DirectionalLight> {
 public:
  explicit Kernel(const SkyLight::Parameters& parameters)
      : Kernel<DirectionalLight>(
            {.direction = parameters.sundirection, .color = sun_irradiance(parameters), .angle = 0.53}) {}
};

}  // namespace raytrace
