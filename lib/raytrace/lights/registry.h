// All lights. A new light: its own pair of files, one include and one name here, and one
// include in kernels.h. (docs/how-to-add-a-type.md) The kernel of the environment light is scene/environment.h, since
// it needs textures.
#pragma once

#include "raytrace/lights/ambient_light.h"
#include "raytrace/lights/directional_light.h"
#include "raytrace/lights/environment_light.h"
#include "raytrace/lights/point_light.h"
#include "raytrace/lights/sky_light.h"
#include "raytrace/lights/spot_light.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Lights = TypeList<AmbientLight, PointLight, DirectionalLight, SpotLight, EnvironmentLight, SkyLight>;

}  // namespace raytrace
