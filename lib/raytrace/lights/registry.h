// All lights. A new light: its own pair of files, one include and one name here, and one
// include in kernels.h. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/lights/ambient_light.h"
#include "raytrace/lights/directional_light.h"
#include "raytrace/lights/point_light.h"
#include "raytrace/lights/spot_light.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Lights = TypeList<AmbientLight, PointLight, DirectionalLight, SpotLight>;

}  // namespace raytrace
